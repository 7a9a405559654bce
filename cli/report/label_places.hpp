// Where to write labels beside marks of a plot so that none covers another or a mark. Lengths are in pixels,
// from the lower left corner of the plot.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace hitpipe::cli {

struct Mark {
  double x;
  double y;
};

struct LabelPlace {
  double left;    ///< of the text
  double middle;  ///< its height
  bool line;      ///< stands off from its mark, to which a line is to lead
  double line_x;  ///< where that line ends
};

/// Labels for the first marks, one for each text; the other marks are only in the way. Tries places farther
/// and farther off; a label for which there is none is put beside its mark all the same.
[[nodiscard]] std::vector<LabelPlace> place_labels(std::span<const Mark> marks,
                                                   std::span<const std::string> texts, Mark plot_size);

}  // namespace hitpipe::cli
