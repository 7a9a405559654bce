// A stiffness report as a picture: percent against the ratio of the direction's components, a panel for each
// design, a line for each format. Drawn by gnuplot as SVG, in colours that the colour-blind tell apart
// (Okabe and Ito) and with a mark for each line.
#pragma once

#include <string>
#include <vector>

namespace hitpipe::cli {

struct PlotLine {
  std::string title;            ///< the format
  std::vector<double> percent;  ///< by stiffness; the last is the zero component's
};

struct PlotPanel {
  std::string title;  ///< the design
  std::vector<PlotLine> lines;
};

struct Plot {
  std::string title;
  std::string counted;         ///< in percent, for the axis
  std::vector<int> exponents;  ///< of the ratios, one fewer than percentages
  std::vector<PlotPanel> panels;
  double least;  ///< the axis' lower end; smaller percentages are drawn on it
};

/// The gnuplot program of a plot; the same text for the same numbers.
[[nodiscard]] std::string plot_script(const Plot& plot);

/// Throws std::runtime_error, one line, when gnuplot is missing or fails.
[[nodiscard]] std::string draw_plot(const Plot& plot);

}  // namespace hitpipe::cli
