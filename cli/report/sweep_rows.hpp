// What a report reads from the rows of a sweep. Cells have the text of the CSV file, so a reader can find
// each printed cell there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/sweep/row.hpp"

namespace hitpipe::cli {

/// A design with its format, or its name alone where it has one format only; "int_slabs 20/24 II 3" at an
/// interval of 3 cycles.
[[nodiscard]] std::string unit_name(const sim::SweepRow& row);

/// The unit is one of the six in Table 7.2.
[[nodiscard]] bool is_thesis_unit(const sim::SweepRow& row);

/// The row's text in a column of sim::sweep_columns.
[[nodiscard]] std::string cell(const sim::SweepRow& row, std::string_view column);

/// The number of rays in flight that most rows have. If several are equally frequent, the greatest. 0 without
/// rows.
[[nodiscard]] int usual_rays_in_flight(std::span<const sim::SweepRow> rows);

/// Sums over all rows that must be zero. False misses count only for conservative units.
struct Wrong {
  std::uint64_t false_misses = 0;
  std::uint64_t rtl_mismatches = 0;
  std::uint64_t different_triangles = 0;
  std::uint64_t different_pixels = 0;
  std::uint64_t core_answers = 0;  ///< that are not software's

  [[nodiscard]] bool any() const {
    return false_misses + rtl_mismatches + different_triangles + different_pixels + core_answers > 0;
  }
};
[[nodiscard]] Wrong wrong_in(std::span<const sim::SweepRow> rows);

inline constexpr double no_limit = std::numeric_limits<double>::infinity();

/// The place of the row with the least whole cost, among those with this number of rays in flight and at most
/// so many extra box tests. Nothing when there is none.
[[nodiscard]] std::optional<std::size_t> cheapest(std::span<const sim::SweepRow> rows, int rays_in_flight,
                                                  double most_extra_box_tests_pct = no_limit);
/// The same by box tests alone, as the thesis compares.
[[nodiscard]] std::optional<std::size_t> cheapest_boxes(std::span<const sim::SweepRow> rows,
                                                        int rays_in_flight);

struct NamedRow {
  std::string name;  ///< what it is the best in
  std::size_t row;
};
/// The cheapest rows within several errors, of all, and by box tests alone.
[[nodiscard]] std::vector<NamedRow> best_rows(std::span<const sim::SweepRow> rows);

/// "mm²", or "LUT" on a chip.
[[nodiscard]] std::string area_unit(const sim::SweepRow& row);

/// What a unit costs, with and without triangle tests: "0.97 mm² ms, of box tests alone 0.55; ...".
[[nodiscard]] std::string cost_text(const sim::SweepRow& row);

/// The cheapest unit; and, if another is cheaper by box tests alone, what that costs as a whole. Lines
/// without their ends.
[[nodiscard]] std::vector<std::string> recommendation(std::span<const sim::SweepRow> rows);

/// What the whole cost counts, at which cost of a triangle test, and what it leaves out.
[[nodiscard]] std::string cost_caveat(const sim::SweepRow& row);

}  // namespace hitpipe::cli
