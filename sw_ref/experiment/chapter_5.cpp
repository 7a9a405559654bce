// Tables 5.1 to 5.7: nodes of 4 and 8 bits a coordinate, relative to the parent, against binary32 nodes, by
// BVH-Plu-DSA; single rays, bundles of 64 and of 256.
#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "sw_ref/experiment/metric.hpp"
#include "sw_ref/experiment/printed.hpp"
#include "sw_ref/experiment/recording.hpp"
#include "sw_ref/experiment/tables.hpp"
#include "sw_ref/experiment/test_scene.hpp"

namespace hitpipe::ref {
namespace {

/// The work and time of one encoding for one scene.
struct Encoded {
  RenderCounts counts;
  double seconds = 0;
  double seconds_with_table = 0;
  std::uint64_t different = 0;
  double bytes = 0;
};

constexpr std::array encodings{Encoding::plain, Encoding::hierarchical_4, Encoding::hierarchical_8};
using SceneResult = std::array<Encoded, encodings.size()>;

int bundle_of(std::string_view number) {
  if (number == "5.1" || number == "5.2") return 1;
  return number == "5.7" ? 256 : 64;
}

SceneResult run(const Scene& scene, int bundle, const ExperimentOptions& options) {
  // Table 5.7 has four times the pixels of the others, so that four times the rays fill a bundle.
  const int finer = bundle == 256 ? 2 : 1;
  const Bvh bvh = build_bvh(scene.mesh);
  const std::vector<RecordedBatch> batches =
      record_rays(scene, bvh, options.width * finer, options.height * finer, bundle);
  SceneResult result;
  for (std::size_t i = 0; i < encodings.size(); ++i) {
    TracerOptions tracing;
    tracing.algorithm = Algorithm::plu_dsa;
    tracing.arithmetic = Arithmetic::binary32;
    tracing.triangle_test = TriangleTest::binary32;
    tracing.encoding = encodings[i];
    tracing.bundle = bundle;
    const std::unique_ptr<Tracer> tracer = make_tracer(scene.mesh, bvh, tracing);
    const Measurement measurement = measure(*tracer, batches, options.repeats);
    Encoded& encoded = result[i];
    encoded.counts = measurement.counts;
    encoded.seconds = encoded.seconds_with_table = measurement.seconds;
    encoded.different = measurement.different;
    encoded.bytes = static_cast<double>(tracer->bytes_per_node() * tracer->node_count());
    if (encodings[i] == Encoding::plain) continue;
    tracing.look_up_table = true;
    encoded.seconds_with_table =
        measure(*make_tracer(scene.mesh, bvh, tracing), batches, options.repeats).seconds;
  }
  return result;
}

/// The value of a printed metric in our run: per ray of the metric's kind, in bytes or in seconds. Nothing if
/// the scene has no such rays.
std::optional<double> value(const Encoded& encoded, const std::string& metric) {
  if (metric == "bvh_memory") return encoded.bytes;
  if (metric == "time") return encoded.seconds;
  if (metric == "time_lut") return encoded.seconds_with_table;
  return per_ray(encoded.counts, metric);
}

/// The float value, then memory as a value and everything else as an increase in percent. For times the float
/// value is 1.
std::vector<std::optional<double>> our_figures(const SceneResult& scene, const std::string& metric) {
  const std::optional<double> plain = value(scene[0], metric);
  if (!plain) return std::vector<std::optional<double>>(encodings.size());
  const bool is_time = metric.starts_with("time");
  std::vector<std::optional<double>> figures{is_time ? 1.0 : *plain};
  for (std::size_t i = 1; i < encodings.size(); ++i) {
    const double encoded = *value(scene[i], metric);
    figures.emplace_back(metric == "bvh_memory" ? encoded : 100.0 * (encoded / *plain - 1.0));
  }
  return figures;
}

std::vector<std::optional<double>> printed_figures(const PrintedRow& row, const std::string& metric) {
  if (metric == "bvh_memory") return {row.number("fp32"), row.number("int4_abs"), row.number("int8_abs")};
  if (metric.starts_with("time")) return {1.0, row.number("int4_pct"), row.number("int8_pct")};
  return {row.number("fp32"), row.number("int4_pct"), row.number("int8_pct")};
}

/// The range of an encoding's increases over all rows whose metric contains `part`.
struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
};

Range range(const ResultTable& table, std::string_view part, std::size_t column) {
  Range range;
  for (const ResultRow& row : table.rows) {
    if (row.labels[1].find(part) == std::string::npos || !row.ours[column]) continue;
    range.low = std::min(range.low, *row.ours[column]);
    range.high = std::max(range.high, *row.ours[column]);
  }
  return range;
}

Finding within(const ResultTable& table, const std::string& claim, std::string_view part, std::size_t column,
               double low, double high) {
  const Range ours = range(table, part, column);
  return {claim, ours.low >= low && ours.high <= high,
          fmt::format("{:.1f} to {:.1f} %", ours.low, ours.high)};
}

std::vector<Finding> chapter_5_findings(const ResultTable& table) {
  const bool has_tests = table.number != "5.7";
  std::vector<Finding> all;
  if (has_tests) {
    all.push_back(within(table, "8 bits cost up to 4 % more tests", "tests", 2, -0.5, 4.5));
    all.push_back(within(table, "4 bits cost 4 to 32 % more tests", "tests", 1, 3.5, 32.5));
  }
  if (bundle_of(table.number) == 1) {
    const Range plain = range(table, "time", 2);
    all.push_back({"for single rays decoding 8 bits takes visible time, 26 to 52 % more", plain.low > 20.0,
                   fmt::format("{:.0f} to {:.0f} %", plain.low, plain.high)});
  } else {
    all.push_back(within(table, "bundles make 8 bits nearly free, up to 6 %", "time", 2, -5.0, 6.5));
  }
  return all;
}

}  // namespace

ResultTable hierarchical_encoding(std::string_view number, const ExperimentOptions& options) {
  const PrintedTable& printed = printed_table(number);
  const int bundle = bundle_of(number);
  const std::vector<std::string> scenes = scenes_of_table(number, options);
  ResultTable table;
  table.number = number;
  table.title = fmt::format("Hierarchical nodes, {}: per ray, then change in %",
                            bundle == 1 ? "single rays" : fmt::format("bundles of {}", bundle));
  table.labels = {"scene", "metric"};
  table.columns = {{"fp32", 3}, {"int4", 1}, {"int8", 1}};
  std::uint64_t rays = 0;
  std::uint64_t different = 0;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const std::optional<Scene> scene = test_scene(scenes[i], options);
    table.notes.push_back(scene_note(scenes[i], scene));
    std::optional<SceneResult> result;
    if (scene) result = run(*scene, bundle, options);
    for (const PrintedRow& thesis : printed.rows()) {
      if (thesis.text("scene") != scenes[i]) continue;
      const std::string& metric = thesis.text("metric");
      ResultRow& row =
          table.rows.emplace_back(ResultRow{{scenes[i], metric}, {}, printed_figures(thesis, metric)});
      row.ours = result ? our_figures(*result, metric) : std::vector<std::optional<double>>(encodings.size());
    }
    if (result) {
      for (const Encoded& encoded : *result) {
        rays += encoded.counts.total().rays;
        different += encoded.different;
      }
    }
    options.progress(static_cast<double>(i + 1) / static_cast<double>(scenes.size()));
  }
  table.findings = chapter_5_findings(table);
  table.notes.push_back(
      fmt::format("bvh_memory in bytes; time: binary32 is 1, traversal alone, the fastest of {} runs on one "
                  "thread; {} of {} "
                  "answers of Moeller-Trumbore differ from the exact test's",
                  options.repeats, different, rays));
  return table;
}

}  // namespace hitpipe::ref
