// What the plots of hitpipe share: gnuplot, which draws SVG, a logarithmic axis, and places for marks, in
// pixels from the lower left corner of the plot.
#pragma once

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

/// Units of a design that would cover one another share a mark that names them all; marks of different
/// designs that would cover one another stand side by side. `places[i]` is unit i's position. Marks are
/// ordered by their first unit.
[[nodiscard]] std::vector<UnitMark> unit_marks(std::span<const sim::SweepRow> units,
                                               std::span<const Mark> places);

}  // namespace hitpipe::cli
