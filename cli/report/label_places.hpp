// Finds places for labels of a plot's marks, so that no label covers another label or a mark. Lengths are in
// pixels from the lower left corner of the plot.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace hitpipe::cli {

/// Of a mark, in pixels.
inline constexpr double mark_radius = 6.0;

struct Mark {
  double x;
  double y;
};

struct LabelPlace {
  double left;    ///< left end of the text
  double middle;  ///< middle height of the text
  bool line;      ///< the label is away from its mark, so a line must lead there
  double line_x;  ///< where that line ends
};

/// Places labels for the first marks, one for each text. The other marks only take space. It tries places
/// farther and farther away. A label that fits nowhere goes beside its mark all the same.
[[nodiscard]] std::vector<LabelPlace> place_labels(std::span<const Mark> marks,
                                                   std::span<const std::string> texts, Mark plot_size);

}  // namespace hitpipe::cli
