// A stiffness report as a picture: percent against the ratio of the direction's components, with a panel for
// each design and a line for each format. gnuplot draws it as SVG. Each line has a mark, and colours that
// colour-blind readers can tell apart (Okabe and Ito).
#pragma once

#include <string>
#include <vector>

namespace hitpipe::cli {

struct PlotLine {
  std::string title;            ///< the format
  std::vector<double> percent;  ///< by stiffness; the last is for a zero component
};

struct PlotPanel {
  std::string title;  ///< the design
  std::vector<PlotLine> lines;
};

struct Plot {
  std::string title;
  std::string counted;         ///< what is counted, in percent; the label of the axis
  std::vector<int> exponents;  ///< of the ratios; one fewer than percentages
  std::vector<PlotPanel> panels;
  double least;  ///< lower end of the axis; smaller percentages are drawn there
};

/// The gnuplot program of a plot. It is the same text for the same numbers.
[[nodiscard]] std::string plot_script(const Plot& plot);

/// Throws std::runtime_error, one line, when gnuplot is missing or fails.
[[nodiscard]] std::string draw_plot(const Plot& plot);

}  // namespace hitpipe::cli
