#include "cli/text/sweep_rows.hpp"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "rtl_gen/catalogue/design.hpp"

namespace hitpipe::cli {

namespace {

using Rows = std::span<const sim::SweepRow>;
using Cost = double (sim::SweepRow::*)() const;

std::optional<std::size_t> least(Rows rows, int rays_in_flight, Cost cost) {
  std::optional<std::size_t> best;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const sim::SweepRow& unit = rows[row];
    if (unit.rays_in_flight != rays_in_flight) continue;
    if (!best || (unit.*cost)() < (rows[*best].*cost)()) best = row;
  }
  return best;
}

/// "int_slabs 20/24 II 3" at an interval of 3 cycles.
std::string unit_name(const sim::SweepRow& row) {
  const rtl::Design& design = rtl::find_design(row.design);
  const std::string name = design.name_at(design.parse_format(row.bits));
  return row.interval == 1 ? name : fmt::format("{} II {}", name, row.interval);
}

/// The number that most rows have; the greatest of several equally frequent ones.
int usual_rays_in_flight(Rows rows) {
  std::map<int, int> rows_with;
  for (const sim::SweepRow& row : rows) ++rows_with[row.rays_in_flight];
  int usual = 0;
  for (const auto& [rays, count] : rows_with) {
    if (usual == 0 || count >= rows_with[usual]) usual = rays;
  }
  return usual;
}

/// "0.37 % (95 %: 0.27 to 0.51)".
std::string extra_text(double pct, const std::optional<double>& low, const std::optional<double>& high) {
  return fmt::format("{:.3g} %", pct) +
         (low && high ? fmt::format(" (95 %: {:.2g} to {:.2g})", *low, *high) : "");
}

/// "mm²", or "LUT" on a chip.
std::string area_unit(const sim::SweepRow& row) {
  return row.on_chip() ? "LUT" : "mm²";
}

}  // namespace

std::string cost_text(const sim::SweepRow& row) {
  const std::optional<double> energy = row.energy_nj_per_ray();
  return fmt::format(
      "{:.4g} {} ms, of box tests alone {:.4g}; extra box tests {}; extra triangle tests {}; {:.4g} bytes{} "
      "a ray{}",
      row.whole_area_run_time(), area_unit(row), row.area_run_time(),
      extra_text(row.extra_box_tests_pct(), row.extra_box_pct_low, row.extra_box_pct_high),
      extra_text(row.extra_triangle_tests_pct(), row.extra_triangle_pct_low, row.extra_triangle_pct_high),
      row.bytes_per_ray(), energy ? fmt::format(" and {:.3g} nJ", *energy) : "",
      row.on_chip() ? fmt::format(", {} multiplier blocks", row.multiplier_blocks) : "");
}

std::vector<std::string> recommendation(Rows rows) {
  const int rays = usual_rays_in_flight(rows);
  const std::optional<std::size_t> whole = least(rows, rays, &sim::SweepRow::whole_area_run_time);
  if (!whole) return {};
  std::vector<std::string> lines{
      fmt::format("Least whole area × time: {}: {}.", unit_name(rows[*whole]), cost_text(rows[*whole]))};
  const std::size_t boxes = *least(rows, rays, &sim::SweepRow::area_run_time);
  if (boxes == *whole) return lines;
  const double more = 100.0 * (rows[boxes].whole_area_run_time() / rows[*whole].whole_area_run_time() - 1.0);
  lines.push_back(fmt::format("By box tests alone it would be {}, which costs {:.3g} % more as a whole: {}.",
                              unit_name(rows[boxes]), more, cost_text(rows[boxes])));
  return lines;
}

std::string cost_caveat(const sim::SweepRow& row) {
  const bool set_up = row.set_up.divisions.has_value();
  const std::string unit = row.on_chip()
                               ? fmt::format("{} LUTs", row.triangle.luts)
                               : fmt::format("{:.4g} mm²", static_cast<double>(row.triangle.area_um2) / 1e6);
  return fmt::format(
      "Whole counts box tests, triangle tests{}. A triangle test is taken as {:.4g} ns of a unit of {}. {}"
      "Shading and waiting for memory are left out; bytes a ray are read without a cache.{}",
      set_up ? " and the divisions of ray set-up" : "", static_cast<double>(row.triangle.delay_ps) / 1e3,
      unit, set_up ? "" : "Set-up of rays is not counted. ",
      row.on_chip() ? " Area is lookup tables alone: weigh multiplier blocks and registers beside them."
                    : "");
}

}  // namespace hitpipe::cli
