// The result of repeating an experiment of the thesis: our figures and the printed ones, and whether the
// thesis's findings hold in this run.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "sw_ref/judge/interval.hpp"
#include "thesis/reference.hpp"
#include "thesis/verdict.hpp"

namespace hitpipe::thesis {

/// The thesis prints whole percents.
inline constexpr double half_percent = 0.5;

/// A column of figures.
struct ResultColumn {
  std::string name;
  int decimals = 0;      ///< in text; csv and json keep all digits
  double half_unit = 0;  ///< of the last digit that the thesis prints
};

struct ResultRow {
  std::vector<std::string> labels;             ///< one for each of ResultTable::labels
  std::vector<std::optional<double>> ours;     ///< one a column; nothing: not measured
  std::vector<std::optional<double>> printed;  ///< one a column; nothing: not printed
  /// 95 %, of ours, by the spread among the tiles of the image, of times by the order of the runs. One a column, or
  /// none at all; nothing: not from a sample of rays, or from too few runs.
  std::vector<std::optional<Interval>> intervals{};
  std::optional<std::size_t> unit{};  ///< the column that is 1 by definition, and so is not judged
};

/// A statement of the thesis, compared with this run. The worst of its figures decides.
struct Finding {
  std::string claim;
  std::vector<Comparison> figures;  ///< at least one
  std::string why{};                ///< why ours is another figure, where that is known

  [[nodiscard]] const Comparison& worst() const { return worst_of(figures); }
  [[nodiscard]] Verdict verdict() const { return verdict_of(worst()); }
};

/// Why extra work is more than the thesis's, on scenes with flat floors and walls.
inline constexpr const char* starts_inside =
    "our rays start 2^-17 beside the surface that they leave. Where it lies across an axis, they start "
    "inside the "
    "coarse box around it, and its few triangles are tested";

/// Of what takes so many times as long, in percent.
[[nodiscard]] inline std::optional<Interval> percent_more(const ref::Middle& ratio) {
  if (!ratio.interval) return std::nullopt;
  return Interval{100 * (ratio.interval->low - 1), 100 * (ratio.interval->high - 1)};
}
/// Rows of too few runs have none.
inline void drop_empty_intervals(ResultRow& row) {
  const auto is_some = [](const std::optional<Interval>& each) { return each.has_value(); };
  if (std::none_of(row.intervals.begin(), row.intervals.end(), is_some)) row.intervals.clear();
}
/// Fewer runs give no interval.
inline constexpr int runs_of_interval = 6;
inline constexpr const char* interval_note = "+-95 %: the interval of the median by the order of the runs";

/// Why a time is another.
inline constexpr const char* other_machine = "another processor and compiler";

struct ResultTable {
  std::string number;               ///< "5.1"
  std::string title;                ///< one line, with units
  std::vector<std::string> labels;  ///< names of the label columns; rows are grouped by the first
  std::vector<ResultColumn> columns;
  std::vector<ResultRow> rows;
  std::vector<Finding> findings;   ///< none where nothing of the table was measured
  std::vector<std::string> notes;  ///< stand-ins, sizes, seeds: what a reader must know to judge the figures
};

}  // namespace hitpipe::thesis
