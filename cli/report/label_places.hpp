// Places for the labels of a plot's marks, so that none covers another one, a mark or a line. Places are from
// the lower left corner of the plot, in units of which twelve are the size of a letter.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hitpipe::cli {

inline constexpr double mark_radius = 6.0;
inline constexpr double line_height = 15.0;

struct Mark {
  double x;
  double y;
  double radius = mark_radius;
};

/// One mark lies on the other, at least in part.
[[nodiscard]] bool cover(const Mark& a, const Mark& b);

/// A line that the plot has.
struct PlotSegment {
  Mark from;
  Mark to;
};

/// The width of a text in sans-serif, rounded up.
[[nodiscard]] double text_width(std::string_view text);

/// Which point of a text is certain: its width depends on the reader's fonts.
enum class Align { left, centre, right };

struct LabelPlace {
  double left;
  double right;
  double middle;  ///< of its height
  Align align;
  bool line;          ///< the label is away from its mark, so a line must lead from there to anchor()
  bool clear = true;  ///< it lies on nothing; without those that are not clear, the others lie on nothing

  [[nodiscard]] double anchor() const {
    return align == Align::left ? left : align == Align::right ? right : (left + right) / 2;
  }
};

/// Places labels for the first marks, one for each text; the other marks only take space. If there is a way,
/// no label lies on a mark, a label or a line, and no label's line does or crosses another. Labels are near
/// their marks.
[[nodiscard]] std::vector<LabelPlace> place_labels(std::span<const Mark> marks,
                                                   std::span<const std::string> texts, Mark plot_size,
                                                   std::span<const PlotSegment> lines = {});

}  // namespace hitpipe::cli
