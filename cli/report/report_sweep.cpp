#include "cli/report/report_sweep.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "area_model/price.hpp"

namespace hitpipe::cli {

namespace {

constexpr std::array<int, 1> usual_rays{32};
constexpr std::array<int, 9> many_rays{1, 2, 4, 8, 16, 32, 64, 128, 256};

/// Each value once, in order.
template <class Value>
void append_once(std::vector<Value>& values, const Value& value) {
  if (std::find(values.begin(), values.end(), value) == values.end()) values.push_back(value);
}

}  // namespace

std::vector<ReportUnit> report_units(const std::vector<sim::DesignFormats>& formats, bool named) {
  std::vector<ReportUnit> units;
  if (!named) {
    for (const area::Entry& entry : area::table_7_2())
      units.push_back({&rtl::find_design(entry.design), entry.format});
    return units;
  }
  for (const sim::DesignFormats& each : formats) {
    const bool usual = std::ranges::find(each.formats, each.design->default_format) != each.formats.end();
    units.push_back({each.design, usual ? each.design->default_format : each.formats.back()});
  }
  return units;
}

std::vector<sim::SweepPoint> report_points(const std::vector<sim::DesignFormats>& formats,
                                           const std::vector<ReportUnit>& units,
                                           const std::vector<int>& intervals, const rtl::Library& library) {
  std::map<sim::RowKey, sim::SweepPoint> points;
  const auto add = [&](const std::vector<sim::SweepPoint>& more) {
    for (const sim::SweepPoint& point : more) points.emplace(sim::key_of(point), point);
  };
  add(sim::plan_sweep(formats, usual_rays, intervals));
  for (const ReportUnit& unit : units) {
    const sim::DesignFormats alone{unit.design, {unit.format}};
    if (!sim::why_not_priced(*unit.design, unit.format, library).empty()) continue;
    add(sim::plan_sweep({&alone, 1}, many_rays));
  }
  std::vector<sim::SweepPoint> all;
  for (const auto& [key, point] : points) all.push_back(point);
  return all;
}

std::vector<sim::SweepRow> take_rows(const std::filesystem::path& file, const sim::SweepSubject& subject) {
  std::vector<sim::SweepRow> rows = sim::read_rows_of(file, subject);
  if (rows.empty()) throw std::runtime_error(fmt::format("{}: holds no rows", file.string()));
  return rows;
}

std::vector<std::string> sweep_commands(std::span<const sim::SweepRow> rows,
                                        const std::string& scene_options) {
  // Units that were measured with the same numbers of rays at the same intervals belong to one sweep command.
  using IntervalsAndRays = std::set<std::pair<int, int>>;  // intervals and rays
  std::map<std::pair<std::string, std::string>, IntervalsAndRays> measured;
  for (const sim::SweepRow& row : rows)
    measured[{row.design, row.bits}].insert({row.interval, row.rays_in_flight});
  struct Sweep {
    std::vector<std::string> designs;
    std::vector<std::string> bits;
  };
  std::map<IntervalsAndRays, Sweep> sweeps;
  for (const sim::SweepRow& row : rows) {
    Sweep& sweep = sweeps[measured[{row.design, row.bits}]];
    append_once(sweep.designs, row.design);
    const rtl::Design& design = rtl::find_design(row.design);
    if (!design.default_format.family().single) append_once(sweep.bits, row.bits);
  }
  std::vector<std::string> commands;
  for (const auto& [pairs, sweep] : sweeps) {
    std::set<int> rays;
    std::set<int> intervals;
    for (const auto& [interval, number] : pairs) {
      intervals.insert(interval);
      rays.insert(number);
    }
    const std::string ii = intervals == std::set{1} ? "" : fmt::format(" --ii {}", fmt::join(intervals, ","));
    const std::string bits = sweep.bits.empty() ? "" : fmt::format(" --bits {}", fmt::join(sweep.bits, ","));
    commands.push_back(fmt::format("hitpipe sweep {} {}{} --rays-in-flight {}{} --out rows.csv",
                                   scene_options, fmt::join(sweep.designs, ","), bits, fmt::join(rays, ","),
                                   ii));
  }
  return commands;
}

}  // namespace hitpipe::cli
