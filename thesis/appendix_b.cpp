// Tables B.1 to B.8: how the largest number of triangles in a leaf affects time and memory.
#include <algorithm>
#include <array>
#include <initializer_list>
#include <map>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "sw_ref/hierarchy/statistics.hpp"
#include "sw_ref/render/recording.hpp"
#include "thesis/printed.hpp"
#include "thesis/tables.hpp"
#include "thesis/test_scene.hpp"

namespace hitpipe::thesis {
namespace {

constexpr int unit_size = 6;  // the thesis's choice; its times are 1

/// The order of the thesis's appendix.
constexpr std::array<std::string_view, 8> scenes_of_appendix{
    "Spheres",           "Bunny", "Branch", "Poppy", "Powerplant-Front", "Powerplant-North",
    "Powerplant-Boiler", "Lucy"};

struct Step {
  std::vector<double> render_seconds, build_seconds;  ///< of each run
  double nodes;
};

std::map<int, Step> measured(const Scene& scene, const ExperimentOptions& options) {
  const std::vector<RecordedBatch> batches =
      record_rays(scene, build_bvh(scene.mesh), options.width, options.height, 1);
  TracerOptions tracing;
  tracing.algorithm = Algorithm::plu_dsa;
  tracing.arithmetic = Arithmetic::binary32;
  tracing.triangle_test = TriangleTest::binary32;
  std::map<int, Step> steps;
  BuildOptions building;
  building.threads = 1;
  sweep_max_triangles(scene.mesh, building, [&](const SweepStep& step) {
    const Measurement measurement =
        measure(*make_tracer(scene.mesh, step.bvh, tracing), batches, options.repeats);
    steps[step.max_triangles] = {
        measurement.seconds, {step.build_seconds}, static_cast<double>(step.bvh.nodes.size())};
    options.progress(static_cast<double>(steps.size()) / static_cast<double>(appendix_b_sizes.size()));
  });
  for (int run = 1; run < options.repeats; ++run)
    sweep_max_triangles(scene.mesh, building, [&](const SweepStep& step) {
      steps.at(step.max_triangles).build_seconds.push_back(step.build_seconds);
    });
  return steps;
}

std::optional<double> ratio(std::optional<double> value, std::optional<double> unit) {
  if (!value || !unit) return std::nullopt;
  return *value / *unit;
}

}  // namespace

ResultTable leaf_sizes(std::string_view number, const ExperimentOptions& options) {
  const PrintedTable& printed = printed_table(number);
  const std::string name(scenes_of_appendix.at(static_cast<std::size_t>(number.back() - '1')));
  const std::optional<Scene> scene = test_scene(name, options);
  std::map<int, Step> steps;
  if (scene) steps = measured(*scene, options);
  ResultTable table;
  table.number = number;
  table.title = fmt::format("{}: most triangles in a leaf; times with {} are 1", name, unit_size);
  table.labels = {"max_tris"};
  table.columns = {{"render", 2, 0.005}, {"build", 2, 0.005}, {"nodes", 0}};
  table.notes.push_back(scene_note(name, scene));
  const PrintedRow& unit = *printed.find({std::to_string(unit_size)});
  for (const PrintedRow& thesis : printed.rows()) {
    const auto size = static_cast<int>(*thesis.number("max_tris"));
    ResultRow& row = table.rows.emplace_back(
        ResultRow{.labels = {std::to_string(size)},
                  .ours = std::vector<std::optional<double>>(table.columns.size()),
                  .printed = {ratio(thesis.number("rendering_time_s"), unit.number("rendering_time_s")),
                              ratio(thesis.number("build_time_s"), unit.number("build_time_s")),
                              thesis.number("bvh_nodes")}});
    if (!scene) continue;
    const Step& step = steps.at(size);
    const Step& of_unit = steps.at(unit_size);
    const ref::Middle render = ref::middle_ratio(step.render_seconds, of_unit.render_seconds);
    const ref::Middle build = ref::middle_ratio(step.build_seconds, of_unit.build_seconds);
    row.ours = {render.median, build.median, step.nodes};
    row.intervals = {render.interval, build.interval, std::nullopt};
    drop_empty_intervals(row);
  }
  if (scene) {
    const auto row_of = [&](int size) -> const ResultRow& {
      return *std::find_if(table.rows.begin(), table.rows.end(),
                           [&](const ResultRow& row) { return row.labels.front() == std::to_string(size); });
    };
    const auto render = [&](const std::string& claim, std::initializer_list<int> sizes) {
      Finding finding{claim, {}, {}};
      for (const int size : sizes)
        finding.figures.push_back({fmt::format("time with {} over that with {}", size, unit_size),
                                   *row_of(size).printed[0], *row_of(size).ours[0], 0.005});
      table.findings.push_back(std::move(finding));
    };
    render("smaller leaves than 6 triangles do not render faster", {2, 4});
    render("larger leaves render slower, bit by bit", {16, 64, 512});
    const double printed_triangles = *printed_table("scenes").find({name})->number("triangles");
    const auto triangles = static_cast<double>(scene->mesh.triangles.size());
    table.findings.push_back({"6 triangles in a leaf give about half as many nodes as triangles",
                              {{"nodes a triangle", *unit.number("bvh_nodes") / printed_triangles,
                                steps.at(unit_size).nodes / triangles}}});
    table.findings.push_back({"smaller leaves take many more nodes",
                              {{fmt::format("nodes with 2 over those with {}", unit_size),
                                *row_of(2).printed[2] / *unit.number("bvh_nodes"),
                                steps.at(2).nodes / steps.at(unit_size).nodes}}});
  }
  table.notes.push_back(fmt::format("{} x {} pixels, traversal alone, the median of {} runs on one thread",
                                    options.width, options.height, options.repeats));
  if (options.repeats >= runs_of_interval) table.notes.emplace_back(interval_note);
  return table;
}

}  // namespace hitpipe::thesis
