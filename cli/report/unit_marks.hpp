// Marks in a plot. Each stands where its values are; where marks cover one another, the lower are larger, and
// only their labels move away.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "cli/report/plot.hpp"
#include "sim/sweep/row.hpp"

namespace hitpipe::cli {

/// The style of a design in all plots.
[[nodiscard]] DesignStyle style_of(const std::string& design);

struct PlotMark {
  std::string design;  ///< or another name of its style
  std::string name;
  DesignStyle style;
  double x;  ///< values of the axes
  double y;
  Mark place;  ///< where these are
};

/// Where marks of several designs cover one another nearly wholly, makes all but the first larger, so that
/// each is seen when the larger are drawn first.
void enlarge_hidden(std::vector<PlotMark>& marks);

/// The data block $marks, a line for each mark: x, y, size, shape, colour, design and name. The largest are
/// first, so they are below. And the plot of this block.
[[nodiscard]] std::string marks_data(std::span<const PlotMark> marks);
[[nodiscard]] std::string marks_plot();
/// The entry of the key for a style.
[[nodiscard]] std::string mark_key(const DesignStyle& style, const std::string& title);

struct MarkLabel {
  std::string text;
  std::size_t mark;
};
/// Units of a design that cover one another share a label at the one in their middle. It names formats, such
/// as "24/24,28", and the design where it has a single format, or where marks of several designs are at one
/// place.
[[nodiscard]] std::vector<MarkLabel> unit_labels(std::span<const PlotMark> marks);

/// A label for each mark, with its name.
[[nodiscard]] std::vector<MarkLabel> name_labels(std::span<const PlotMark> marks);

/// Labels beside their marks. A line leads to each label that had to move away. A label without room is left
/// out.
struct PlacedLabels {
  std::string settings;
  std::size_t left_out = 0;
};
[[nodiscard]] PlacedLabels place_mark_labels(std::span<const MarkLabel> labels,
                                             std::span<const PlotMark> marks,
                                             std::span<const PlotSegment> lines, const Mark& size);

}  // namespace hitpipe::cli
