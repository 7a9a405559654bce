// Tables 6.1 to 6.7: hierarchies and box tests of n-bit integers with intervals of t bits, against binary32.
#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "host/parallel.hpp"
#include "sw_ref/render/recording.hpp"
#include "thesis/printed.hpp"
#include "thesis/tables.hpp"
#include "thesis/test_scene.hpp"

namespace hitpipe::thesis {
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

/// The last is binary32.
struct SceneCounts {
  std::vector<RecordedBatch> batches;
  std::array<Measurement, formats.size() + 1> by_format;
};

SceneCounts run(const Scene& scene, Algorithm algorithm, const ExperimentOptions& options) {
  const Bvh plain = build_bvh(scene.mesh);
  SceneCounts counts;
  counts.batches = record_rays(scene, plain, options.width, options.height, 1);
  const std::array<Bvh, 3> grids{build_for(scene.mesh, 24), build_for(scene.mesh, 20),
                                 build_for(scene.mesh, 16)};
  const auto count = [&](std::size_t i) {
    const std::unique_ptr<Tracer> tracer =
        i == formats.size() ? float_tracer(scene, plain, algorithm)
                            : integer_tracer(scene, grids.at(i / 3), algorithm, formats.at(i));
    counts.by_format.at(i) = measure(*tracer, counts.batches, 1);
  };
  host::for_each_index(counts.by_format.size(), options.threads, count);
  return counts;
}

void fill_ours(const SceneCounts& counts, const std::string& metric, const std::string& kind_name,
               ResultRow& row) {
  const RayKind kind = kind_name == "pri"   ? RayKind::primary
                       : kind_name == "sec" ? RayKind::secondary
                                            : RayKind::shadow;
  const Count tests = metric == "ray_tri" ? &TraceCounts::triangle_tests : &TraceCounts::box_tests;
  const Measurement& floats = counts.by_format.back();
  RenderCounts float_counts = floats.counts;
  const TraceCounts& reference = float_counts.of(kind);
  if (reference.rays == 0) return;
  row.ours[0] = static_cast<double>(reference.*tests) / static_cast<double>(reference.rays);
  row.intervals.resize(row.ours.size());
  for (std::size_t i = 0; i < formats.size(); ++i) {
    const GroupedRatio factor = ratio_by_tile(counts.batches, kind, tests, counts.by_format.at(i), floats);
    row.ours[i + 1] = 100.0 * (factor.ratio() - 1.0);
    row.intervals[i + 1] = increase_interval(factor);
  }
}

std::vector<std::optional<double>> printed_figures(const PrintedRow& row) {
  std::vector<std::optional<double>> figures{row.number("fp32_per_ray")};
  for (const hls::IntBits& bits : formats)
    figures.push_back(row.number(fmt::format("pct_{}_{}", bits.coord, bits.interval)));
  return figures;
}

/// The largest fall of a figure from one format to the next coarser one, over all rows that were measured.
Finding monotone(const ResultTable& table) {
  const auto largest_fall = [&](auto figures_of) {
    double worst = 0;
    for (const ResultRow& row : table.rows) {
      const std::vector<std::optional<double>>& figures = figures_of(row);
      if (!row.ours.front()) continue;
      for (std::size_t i = 2; i < figures.size(); ++i) worst = std::max(worst, *figures[i - 1] - *figures[i]);
    }
    return worst;
  };
  return {"extra work never falls as bits are taken away",
          {{"largest fall, percentage points", largest_fall([](const auto& row) { return row.printed; }),
            largest_fall([](const auto& row) { return row.ours; }), half_percent}}};
}

/// The largest increase of a column, of one kind of test, on one scene or, with "", on any that was measured.
/// Nothing if none was.
std::optional<Comparison> largest(const ResultTable& table, std::string_view scene, std::string_view tests,
                                  std::size_t column) {
  const ResultRow* most = nullptr;
  double printed = 0;
  for (const ResultRow& row : table.rows) {
    if ((!scene.empty() && row.labels[0] != scene) || row.labels[1] != tests || !row.ours[column]) continue;
    if (most == nullptr || *row.ours[column] > *most->ours[column]) most = &row;
    printed = std::max(printed, *row.printed[column]);
  }
  if (most == nullptr) return std::nullopt;
  return Comparison{
      fmt::format("most, {} tests at {}, %", tests == "tri" ? "triangle" : "box", table.columns[column].name),
      printed, *most->ours[column], half_percent, most->intervals[column]};
}

std::vector<Finding> chapter_6_findings(const ResultTable& table) {
  std::vector<Finding> all{monotone(table)};
  const auto add = [&](const std::string& claim, std::string_view scene, std::size_t column) {
    Finding finding{claim, {}, {}};
    for (const char* const tests : {"tri", "node"})
      if (const auto figure = largest(table, scene, tests, column)) finding.figures.push_back(*figure);
    if (finding.figures.empty()) return;
    const bool more = finding.worst().ours > finding.worst().printed;
    if (more) finding.why = starts_inside;
    if (!more && scene != "Spheres" && scene != "Bunny")
      finding.why = "the stand-in has fewer triangles, so its boxes are larger beside the grid's unit";
    all.push_back(std::move(finding));
  };
  add("24/24 bits cost hardly more tests", "", 3);
  add("20/24 bits are enough for any scene", "", 5);
  for (const char* const scene : {"Spheres", "Bunny"})
    add(fmt::format("16/16 bits are enough for {}", scene), scene, formats.size());
  for (const char* const scene :
       {"Branch", "Poppy", "Powerplant-Front", "Powerplant-North", "Powerplant-Boiler", "Lucy"})
    add(fmt::format("16/16 bits are not enough for {}", scene), scene, formats.size());
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
  table.columns = {{"fp32", 1, 0.0005}};
  for (const hls::IntBits& bits : formats)
    table.columns.push_back({fmt::format("{}/{}", bits.coord, bits.interval), 1, half_percent});
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
      ResultRow& row =
          table.rows.emplace_back(ResultRow{.labels = {scenes[i], metric.substr(metric.find('_') + 1), kind},
                                            .ours = {},
                                            .printed = printed_figures(thesis)});
      row.ours.resize(table.columns.size());
      if (counts) fill_ours(*counts, metric, kind, row);
    }
    for (std::size_t f = 0; counts && f < counts->by_format.size(); ++f) {
      different += counts->by_format.at(f).different;
      traced += counts->by_format.at(f).counts.total().rays;
    }
    options.progress(static_cast<double>(i + 1) / static_cast<double>(scenes.size()));
  }
  if (traced > 0) {
    table.findings = chapter_6_findings(table);
    table.findings.push_back(
        {"every format finds the triangles that binary32 finds",
         {{fmt::format("different answers of {}", traced), 0, static_cast<double>(different)}}});
  }
  table.notes.push_back(fmt::format("{} x {} pixels; hierarchies end at the n-bit grid (section 6.1)",
                                    options.width, options.height));
  table.notes.push_back("+-95 %: the interval by the spread among the tiles of the image");
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
  table.columns = {{"bytes_per_node", 0}, {"nodes", 0}, {"bytes", 0}, {"savings", 0, half_percent}};
  table.notes.push_back(scene_note(name, scene));
  double float_bytes = 0;
  for (const PrintedRow& thesis : printed.rows()) {
    ResultRow& row = table.rows.emplace_back(
        ResultRow{.labels = {thesis.text("precision")},
                  .ours = {},
                  .printed = {thesis.number("bytes_per_node"), thesis.number("bvh_nodes"),
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
  if (!scene) return table;
  Finding bytes{"nodes take 32, 26, 23 and 20 bytes", {}, {}};
  Finding savings{"integer nodes save 19, 28 and 38 % of the memory", {}, {}};
  for (const ResultRow& row : table.rows) {
    bytes.figures.push_back({row.labels[0] + ", bytes", *row.printed[0], *row.ours[0]});
    savings.figures.push_back({row.labels[0] + ", saved, %", *row.printed[3], *row.ours[3], half_percent});
  }
  table.findings = {bytes, savings};
  return table;
}

}  // namespace hitpipe::thesis
