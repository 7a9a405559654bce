// What the plots of hitpipe share: gnuplot, which draws SVG, a logarithmic axis, and places for marks, in
// pixels from the lower left corner of the plot.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "cli/report/label_places.hpp"
#include "sim/sweep/row.hpp"

namespace hitpipe::cli {

/// A gnuplot string that gnuplot takes literally.
[[nodiscard]] std::string gnuplot_string(const std::string& text);

/// The output of gnuplot for the program `script`. Throws std::runtime_error, one line that begins with
/// `command`, when gnuplot is missing or fails.
[[nodiscard]] std::string run_gnuplot(const std::string& command, const std::string& script);

/// Settings of a large plot with this title. The key is below it and has several columns.
inline constexpr std::size_t plot_key_columns = 3;
[[nodiscard]] std::string plot_head(const std::string& title, std::size_t key_entries);
/// What marks lie in, in pixels.
[[nodiscard]] Mark plot_size();

/// A block of data with a name.
[[nodiscard]] std::string data_block(const std::string& name, const std::string& lines);

/// A logarithmic axis that ends where its data does.
class LogAxis {
 public:
  /// Numbers that are not positive have a place of their own below the others, with the tic "≤ 0".
  explicit LogAxis(std::span<const double> values);

  [[nodiscard]] double least() const { return least_; }
  [[nodiscard]] double most() const { return most_; }
  /// Where a value is drawn: a value of the axis.
  [[nodiscard]] double shown(double value) const { return value > 0 ? value : zero_; }
  /// The position of a value as a fraction of the length, and back.
  [[nodiscard]] double share(double value) const;
  [[nodiscard]] double at(double share) const;
  /// As gnuplot takes them: "'1' 1, '2' 2".
  [[nodiscard]] std::string tics() const;

 private:
  double least_ = 1;
  double most_ = 1;
  double zero_ = 0;  ///< 0: the axis has no place for it
};

struct UnitMark {
  std::string design;
  std::string name;  ///< formats of the design, such as "24/24,28,32"; the design where it has one format
  Mark place;
};

/// A label beside each mark. A line leads to each label that had to move away.
[[nodiscard]] std::string mark_labels(std::span<const UnitMark> marks, const Mark& size);

/// Units of a design that would cover one another share a mark that names them all; marks of different
/// designs that would cover one another stand side by side. `places[i]` is unit i's position. Marks are
/// ordered by their first unit.
[[nodiscard]] std::vector<UnitMark> unit_marks(std::span<const sim::SweepRow> units,
                                               std::span<const Mark> places);

}  // namespace hitpipe::cli
