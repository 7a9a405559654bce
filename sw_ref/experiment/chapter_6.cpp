// Tables 6.1 to 6.7: hierarchies and box tests of n-bit integers with intervals of t bits, against binary32.
#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include "sw_ref/experiment/printed.hpp"
#include "sw_ref/experiment/recording.hpp"
#include "sw_ref/experiment/tables.hpp"
#include "sw_ref/experiment/test_scene.hpp"

namespace hitpipe::ref {
namespace {

constexpr std::array<hls::IntBits, 9> formats{
    {{24, 32}, {24, 28}, {24, 24}, {20, 28}, {20, 24}, {20, 20}, {16, 24}, {16, 20}, {16, 16}}};

Bvh build_for(const Mesh& mesh, int grid_bits) {
  BuildOptions options;
  options.grid_bits = grid_bits;
  return build_bvh(mesh, options);
}

std::unique_ptr<Tracer> integer_tracer(const Scene& scene, const Bvh& bvh, Algorithm algorithm,
                                       hls::IntBits bits) {
  TracerOptions options;
  options.algorithm = algorithm;
  options.arithmetic = Arithmetic::integer;
  options.bits = bits;
  return make_tracer(scene.mesh, bvh, options);
}

std::unique_ptr<Tracer> float_tracer(const Scene& scene, const Bvh& bvh, Algorithm algorithm) {
  TracerOptions options;
  options.algorithm = algorithm;
  options.arithmetic = Arithmetic::binary32;
  return make_tracer(scene.mesh, bvh, options);
}

/// Counts by format; the last is binary32.
using SceneCounts = std::array<Measurement, formats.size() + 1>;

SceneCounts run(const Scene& scene, Algorithm algorithm, const ExperimentOptions& options) {
  const Bvh plain = build_bvh(scene.mesh);
  const std::vector<RecordedBatch> batches = record_rays(scene, plain, options.width, options.height, 1);
  const std::array<Bvh, 3> grids{build_for(scene.mesh, 24), build_for(scene.mesh, 20),
                                 build_for(scene.mesh, 16)};
  SceneCounts counts;
  const auto count = [&](std::size_t i) {
    const std::unique_ptr<Tracer> tracer =
        i == formats.size() ? float_tracer(scene, plain, algorithm)
                            : integer_tracer(scene, grids.at(i / 3), algorithm, formats.at(i));
    counts.at(i) = measure(*tracer, batches, 1);
  };
  if (options.threads == 1) {
    for (std::size_t i = 0; i < counts.size(); ++i) count(i);
  } else {
    tbb::parallel_for(std::size_t{0}, counts.size(), count);
  }
  return counts;
}

std::uint64_t tests(const RenderCounts& counts, const std::string& metric, const std::string& kind) {
  const TraceCounts& of = kind == "pri" ? counts.primary : kind == "sec" ? counts.secondary : counts.shadow;
  return metric == "ray_tri" ? of.triangle_tests : of.box_tests;
}

std::uint64_t rays(const RenderCounts& counts, const std::string& kind) {
  return (kind == "pri" ? counts.primary : kind == "sec" ? counts.secondary : counts.shadow).rays;
}

std::vector<std::optional<double>> our_figures(const SceneCounts& counts, const std::string& metric,
                                               const std::string& kind) {
  const RenderCounts& floats = counts.back().counts;
  const auto reference = static_cast<double>(tests(floats, metric, kind));
  std::vector<std::optional<double>> figures(counts.size());
  if (rays(floats, kind) == 0) return figures;
  figures[0] = reference / static_cast<double>(rays(floats, kind));
  for (std::size_t i = 0; i < formats.size(); ++i)
    figures[i + 1] =
        100.0 * (static_cast<double>(tests(counts.at(i).counts, metric, kind)) / reference - 1.0);
  return figures;
}

std::vector<std::optional<double>> printed_figures(const PrintedRow& row) {
  std::vector<std::optional<double>> figures{row.number("fp32_per_ray")};
  for (const hls::IntBits& bits : formats)
    figures.push_back(row.number(fmt::format("pct_{}_{}", bits.coord, bits.interval)));
  return figures;
}

/// Whether in no row the figure falls by more than `slack` percentage points from one format to the next
/// coarser one.
Finding monotone(const ResultTable& table) {
  constexpr double slack = 0.5;  // the thesis prints whole percents
  std::size_t rows = 0;
  double worst = 0;
  for (const ResultRow& row : table.rows) {
    if (!row.ours.front()) continue;
    ++rows;
    for (std::size_t i = 2; i < row.ours.size(); ++i)
      worst = std::max(worst, *row.ours[i - 1] - *row.ours[i]);
  }
  return {"extra work never falls as bits are taken away", rows > 0 && worst < slack,
          fmt::format("largest fall {:.2f} points in {} rows", worst, rows)};
}

double largest(const ResultTable& table, std::string_view scene, std::size_t column) {
  double most = 0;
  for (const ResultRow& row : table.rows)
    if ((scene.empty() || row.labels[0] == scene) && row.ours[column])
      most = std::max(most, *row.ours[column]);
  return most;
}

std::vector<Finding> chapter_6_findings(const ResultTable& table) {
  std::vector<Finding> all{monotone(table)};
  const double fine = largest(table, "", 3);
  all.push_back({"24/24 bits cost up to 6 % more tests on any scene", fine < 6.5,
                 fmt::format("largest increase {:.1f} %", fine)});
  const bool has_spheres = std::any_of(table.rows.begin(), table.rows.end(), [](const ResultRow& row) {
    return row.labels[0] == "Spheres" && row.ours[0];
  });
  if (has_spheres) {
    const double coarse = largest(table, "Spheres", formats.size());
    all.push_back({"16/16 bits are enough for Spheres, up to 5 % more tests", coarse < 5.5,
                   fmt::format("largest increase {:.1f} %", coarse)});
  }
  return all;
}

}  // namespace

ResultTable integer_traversal(std::string_view number, const ExperimentOptions& options) {
  const bool of_slabs = number < std::string_view("6.5");
  const Algorithm algorithm = of_slabs ? Algorithm::slabs_dsa : Algorithm::plu_dsa;
  const PrintedTable& printed = printed_table(number);
  const std::vector<std::string> scenes = scenes_of_table(number, options);
  ResultTable table;
  table.number = number;
  table.title =
      fmt::format("Integer {}: tests per ray, then change in % at n/t bits", of_slabs ? "slabs" : "Pluecker");
  table.labels = {"scene", "tests", "ray"};
  table.columns = {{"fp32", 1}};
  for (const hls::IntBits& bits : formats)
    table.columns.push_back({fmt::format("{}/{}", bits.coord, bits.interval), 1});
  std::uint64_t different = 0;
  std::uint64_t traced = 0;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const std::optional<Scene> scene = test_scene(scenes[i], options);
    table.notes.push_back(scene_note(scenes[i], scene));
    std::optional<SceneCounts> counts;
    if (scene) counts = run(*scene, algorithm, options);
    for (const PrintedRow& thesis : printed.rows()) {
      if (thesis.text("scene") != scenes[i]) continue;
      const std::string& metric = thesis.text("metric");
      const std::string& kind = thesis.text("ray_kind");
      ResultRow& row = table.rows.emplace_back(
          ResultRow{{scenes[i], metric.substr(metric.find('_') + 1), kind}, {}, printed_figures(thesis)});
      row.ours = counts ? our_figures(*counts, metric, kind)
                        : std::vector<std::optional<double>>(table.columns.size());
    }
    for (std::size_t f = 0; counts && f < counts->size(); ++f) {
      different += counts->at(f).different;
      traced += counts->at(f).counts.total().rays;
    }
    options.progress(static_cast<double>(i + 1) / static_cast<double>(scenes.size()));
  }
  table.findings = chapter_6_findings(table);
  table.findings.push_back({"every format finds the triangles that binary32 finds",
                            different == 0 && traced > 0,
                            fmt::format("{} of {} answers differ", different, traced)});
  table.notes.push_back(fmt::format("{} x {} pixels; hierarchies end at the n-bit grid (section 6.1)",
                                    options.width, options.height));
  return table;
}

ResultTable integer_sizes(std::string_view number, const ExperimentOptions& options) {
  const PrintedTable& printed = printed_table(number);
  const std::string name = "Lucy";
  const std::optional<Scene> scene = test_scene(name, options);
  ResultTable table;
  table.number = number;
  table.title = "Size of " + name + "'s hierarchy by precision; savings against binary32 in %";
  table.labels = {"precision"};
  table.columns = {{"bytes_per_node", 0}, {"nodes", 0}, {"bytes", 0}, {"savings", 0}};
  table.notes.push_back(scene_note(name, scene));
  double float_bytes = 0;
  for (const PrintedRow& thesis : printed.rows()) {
    ResultRow& row =
        table.rows.emplace_back(ResultRow{{thesis.text("precision")},
                                          {},
                                          {thesis.number("bytes_per_node"), thesis.number("bvh_nodes"),
                                           thesis.number("bvh_size_bytes"), thesis.number("savings_pct")}});
    row.ours.resize(table.columns.size());
    options.progress(static_cast<double>(table.rows.size()) / static_cast<double>(printed.rows().size()));
    if (!scene) continue;
    const auto bits = static_cast<int>(*thesis.number("coord_bits"));
    const bool is_float = thesis.text("number_format") == "fp";
    const Bvh bvh = build_for(scene->mesh, is_float ? 0 : bits);
    const std::unique_ptr<Tracer> tracer =
        is_float ? float_tracer(*scene, bvh, Algorithm::slabs_dsa)
                 : integer_tracer(*scene, bvh, Algorithm::slabs_dsa, {bits, bits});
    const double bytes =
        static_cast<double>(tracer->bytes_per_node()) * static_cast<double>(tracer->node_count());
    if (is_float) float_bytes = bytes;
    row.ours = {static_cast<double>(tracer->bytes_per_node()), static_cast<double>(tracer->node_count()),
                bytes, 100.0 * (1.0 - bytes / float_bytes)};
  }
  bool equal = true;
  for (const ResultRow& row : table.rows) equal = equal && (!row.ours[0] || row.ours[0] == row.printed[0]);
  table.findings.push_back(
      {"nodes take 32, 26, 23 and 20 bytes", equal && scene.has_value(), "see the table"});
  return table;
}

}  // namespace hitpipe::ref
