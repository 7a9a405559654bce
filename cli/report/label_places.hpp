// Places for the labels of a plot's marks, so that none covers another one or a mark. Places are in pixels
// from the lower left corner of the plot.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hitpipe::cli {

/// Of a mark, in pixels.
inline constexpr double mark_radius = 6.0;

struct Mark {
  double x;
  double y;
};

/// The width of a text in 12-pixel sans-serif, rounded up.
[[nodiscard]] double text_width(std::string_view text);

/// Which point of a text is certain: its width depends on the reader's fonts.
enum class Align { left, centre, right };

struct LabelPlace {
  double left;
  double right;
  double middle;  ///< of its height
  Align align;
  bool line;  ///< the label is away from its mark, so a line must lead from there to anchor()

  [[nodiscard]] double anchor() const {
    return align == Align::left ? left : align == Align::right ? right : (left + right) / 2;
  }
};

/// Places labels for the first marks, one for each text; the other marks only take space. If there is a way,
/// no label and no line lies on a mark or a label, and no lines cross. Labels are near their marks.
[[nodiscard]] std::vector<LabelPlace> place_labels(std::span<const Mark> marks,
                                                   std::span<const std::string> texts, Mark plot_size);

}  // namespace hitpipe::cli
