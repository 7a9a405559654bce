// What a report reads from the rows of a sweep. Cells have the text of the CSV file, so a reader can find
// each printed cell there.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "sim/sweep/row.hpp"

namespace hitpipe::cli {

/// A design with its format, or its name alone where it has one format only.
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

  [[nodiscard]] bool any() const {
    return false_misses + rtl_mismatches + different_triangles + different_pixels > 0;
  }
};
[[nodiscard]] Wrong wrong_in(std::span<const sim::SweepRow> rows);

}  // namespace hitpipe::cli
