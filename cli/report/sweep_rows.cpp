#include "cli/report/sweep_rows.hpp"

#include <algorithm>
#include <map>

#include "area_model/price.hpp"

namespace hitpipe::cli {

std::string unit_name(const sim::SweepRow& row) {
  const rtl::Design& design = rtl::find_design(row.design);
  return design.name_at(design.parse_format(row.bits));
}

bool is_thesis_unit(const sim::SweepRow& row) {
  const auto& six = area::table_7_2();
  return std::any_of(six.begin(), six.end(), [&](const area::Entry& entry) {
    return entry.design == row.design && rtl::to_string(entry.format) == row.bits;
  });
}

std::string cell(const sim::SweepRow& row, std::string_view column) {
  const auto at = std::find(sim::sweep_columns.begin(), sim::sweep_columns.end(), column);
  return sim::to_cells(row).at(static_cast<std::size_t>(at - sim::sweep_columns.begin()));
}

int usual_rays_in_flight(std::span<const sim::SweepRow> rows) {
  std::map<int, int> rows_with;
  for (const sim::SweepRow& row : rows) ++rows_with[row.rays_in_flight];
  int usual = 0;
  for (const auto& [rays, count] : rows_with) {
    if (usual == 0 || count >= rows_with[usual]) usual = rays;
  }
  return usual;
}

Wrong wrong_in(std::span<const sim::SweepRow> rows) {
  Wrong wrong;
  for (const sim::SweepRow& row : rows) {
    wrong.false_misses += rtl::find_design(row.design).conservative ? row.false_misses : 0;
    wrong.rtl_mismatches += row.rtl_mismatches;
    wrong.different_triangles += row.different_triangles;
    wrong.different_pixels += row.different_pixels;
  }
  return wrong;
}

}  // namespace hitpipe::cli
