// A stiffness report as a picture: percent against the ratio of the direction's components, with a panel for
// each design and a line for each format. Panels are on a grid, with axes and a key in common.
#pragma once

#include <string>
#include <vector>

#include "cli/report/picture.hpp"

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
  std::string name;  ///< of its files
  std::string title;
  std::string counted;         ///< what is counted, in percent; the label of the axis
  std::vector<int> exponents;  ///< of the ratios; one fewer than percentages
  std::vector<PlotPanel> panels;
  double least;  ///< lower end of the axis; smaller percentages are drawn there
};

[[nodiscard]] Picture stiffness_picture(const Plot& plot, const PictureForm& form);

}  // namespace hitpipe::cli
