// What a report asks of the rows of a sweep. Cells are the text of the CSV file, so that whatever is printed
// of them can be found there again.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "sim/sweep/row.hpp"

namespace hitpipe::cli {

/// "int_slabs 20/24", "fp_slabs".
[[nodiscard]] std::string unit_name(const sim::SweepRow& row);

/// One of the six designs of Table 7.2.
[[nodiscard]] bool is_thesis_unit(const sim::SweepRow& row);

/// Above the reference; negative for a unit that makes fewer.
[[nodiscard]] double extra_box_tests_pct(const sim::SweepRow& row);

/// Run time in nanoseconds for each box test that the reference makes.
[[nodiscard]] double run_time_ns(const sim::SweepRow& row);

/// The row's text in one of sim::sweep_columns.
[[nodiscard]] std::string cell(const sim::SweepRow& row, std::string_view column);

/// The number of rays in flight that most rows have; of equals the greatest; 0 without rows.
[[nodiscard]] int usual_rays_in_flight(std::span<const sim::SweepRow> rows);

/// What must be zero, over all rows; false misses of conservative units alone.
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
