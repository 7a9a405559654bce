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

using ByKey = std::map<sim::RowKey, sim::SweepRow>;

sim::RowKey key_of(const sim::SweepRow& row) {
  return sim::key_of(row.design, row.bits, row.rays_in_flight);
}

sim::RowsFile file_of(const std::string& about, const ByKey& rows) {
  sim::RowsFile file{about, {}};
  for (const auto& [key, row] : rows) file.rows.push_back(row);
  return file;
}

sim::RowsFile rows_about(const std::filesystem::path& file, const std::string& about) {
  sim::RowsFile rows = sim::read_rows(file);
  if (rows.about == about) return rows;
  throw std::runtime_error(
      fmt::format("{}: holds rows of \"{}\", asked for are \"{}\"; give rows of the same scene and size, or "
                  "another folder",
                  file.string(), rows.about, about));
}

/// Each once, in their order.
template <class Value>
void append_once(std::vector<Value>& values, const Value& value) {
  if (std::find(values.begin(), values.end(), value) == values.end()) values.push_back(value);
}

}  // namespace

std::vector<sim::SweepPoint> report_points(std::vector<hls::IntBits> formats) {
  if (formats.empty()) formats = sim::sweep_formats();
  std::vector<const rtl::Design*> designs;
  for (const rtl::Design& design : rtl::designs()) designs.push_back(&design);
  std::map<sim::RowKey, sim::SweepPoint> points;
  const auto add = [&](const std::vector<sim::SweepPoint>& more) {
    for (const sim::SweepPoint& point : more) points.emplace(sim::key_of(point), point);
  };
  add(sim::plan_sweep(designs, formats, usual_rays));
  for (const area::Entry& entry : area::table_7_2()) {
    const std::array<const rtl::Design*, 1> design{&rtl::find_design(entry.design)};
    std::vector<hls::IntBits> bits;
    if (!entry.format.is_float()) bits.push_back(entry.format.bits());
    add(sim::plan_sweep(design, bits, many_rays));
  }
  std::vector<sim::SweepPoint> all;
  for (const auto& [key, point] : points) all.push_back(point);
  return all;
}

sim::RowsFile sweep_into(const std::filesystem::path& file, const std::string& program,
                         const ref::Scene& scene, const ref::Bvh& bvh, std::vector<sim::SweepPoint> points,
                         const sim::SweepOptions& options) {
  const std::string about = sim::about_sweep(program, scene, bvh, options);
  ByKey rows;
  if (std::filesystem::exists(file)) {
    for (const sim::SweepRow& row : rows_about(file, about).rows) rows.emplace(key_of(row), row);
  }
  std::erase_if(points, [&](const sim::SweepPoint& point) { return rows.contains(sim::key_of(point)); });
  // Before the long run: a file that cannot be written is known at once.
  sim::write_rows(file, file_of(about, rows));
  sim::run_sweep(scene, bvh, points, options, [&](const sim::SweepRow& row) {
    rows.insert_or_assign(key_of(row), row);
    sim::write_rows(file, file_of(about, rows));
  });
  return file_of(about, rows);
}

sim::RowsFile take_rows(const std::filesystem::path& file, const std::string& about) {
  sim::RowsFile rows = rows_about(file, about);
  if (rows.rows.empty()) throw std::runtime_error(fmt::format("{}: holds no rows", file.string()));
  return rows;
}

std::vector<std::string> sweep_commands(std::span<const sim::SweepRow> rows,
                                        const std::string& scene_options) {
  // Units that were measured with the same numbers of rays are one sweep.
  std::map<std::pair<std::string, std::string>, std::set<int>> rays_of;
  for (const sim::SweepRow& row : rows) rays_of[{row.design, row.bits}].insert(row.rays_in_flight);
  struct Sweep {
    std::vector<std::string> designs;
    std::vector<std::string> bits;
  };
  std::map<std::set<int>, Sweep> sweeps;
  for (const sim::SweepRow& row : rows) {
    Sweep& sweep = sweeps[rays_of[{row.design, row.bits}]];
    append_once(sweep.designs, row.design);
    if (row.bits != rtl::to_string(rtl::Format::fp32())) append_once(sweep.bits, row.bits);
  }
  std::vector<std::string> commands;
  for (const auto& [rays, sweep] : sweeps) {
    const std::string bits = sweep.bits.empty() ? "" : fmt::format(" --bits {}", fmt::join(sweep.bits, ","));
    commands.push_back(fmt::format("hitpipe sweep {} --designs {}{} --rays-in-flight {} --out rows.csv",
                                   scene_options, fmt::join(sweep.designs, ","), bits, fmt::join(rays, ",")));
  }
  return commands;
}

}  // namespace hitpipe::cli
