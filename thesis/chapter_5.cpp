// Tables 5.1 to 5.7: nodes of 4 and 8 bits a coordinate, relative to the parent, against binary32 nodes, by
// BVH-Plu-DSA; single rays, bundles of 64 and of 256.
#include <algorithm>
#include <array>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "sw_ref/render/recording.hpp"
#include "thesis/metric.hpp"
#include "thesis/printed.hpp"
#include "thesis/tables.hpp"
#include "thesis/test_scene.hpp"

namespace hitpipe::thesis {
namespace {

/// The work and time of one encoding for one scene.
struct Encoded {
  Measurement work;
  std::vector<double> seconds_with_table;
  double bytes = 0;
};

constexpr std::array encodings{Encoding::plain, Encoding::hierarchical_4, Encoding::hierarchical_8};

struct SceneResult {
  std::vector<RecordedBatch> batches;
  std::array<Encoded, encodings.size()> by_encoding;
  std::vector<double> single_seconds;  ///< single rays through binary32 nodes, for bundles of 64
};

int bundle_of(std::string_view number) {
  if (number == "5.1" || number == "5.2") return 1;
  return number == "5.7" ? 256 : 64;
}

SceneResult run(const Scene& scene, int bundle, const ExperimentOptions& options) {
  // Table 5.7 has four times the pixels of the others, so that four times the rays fill a bundle.
  const int finer = bundle == 256 ? 2 : 1;
  const Bvh bvh = build_bvh(scene.mesh);
  SceneResult result;
  result.batches = record_rays(scene, bvh, options.width * finer, options.height * finer, bundle);
  for (std::size_t i = 0; i < encodings.size(); ++i) {
    TracerOptions tracing;
    tracing.algorithm = Algorithm::plu_dsa;
    tracing.arithmetic = Arithmetic::binary32;
    tracing.triangle_test = TriangleTest::binary32;
    tracing.encoding = encodings[i];
    tracing.bundle = bundle;
    const std::unique_ptr<Tracer> tracer = make_tracer(scene.mesh, bvh, tracing);
    Encoded& encoded = result.by_encoding.at(i);
    encoded.work = measure(*tracer, result.batches, options.repeats);
    encoded.seconds_with_table = encoded.work.seconds;
    encoded.bytes = static_cast<double>(tracer->bytes_per_node() * tracer->node_count());
    if (encodings.at(i) == Encoding::plain) {
      if (bundle != 64) continue;
      tracing.bundle = 1;
      result.single_seconds =
          measure(*make_tracer(scene.mesh, bvh, tracing),
                  record_rays(scene, bvh, options.width, options.height, 1), options.repeats)
              .seconds;
      continue;
    }
    tracing.look_up_table = true;
    encoded.seconds_with_table =
        measure(*make_tracer(scene.mesh, bvh, tracing), result.batches, options.repeats).seconds;
  }
  return result;
}

/// The value of a printed metric in our run: per ray of the metric's kind, in bytes or in seconds. Nothing if
/// the scene has no such rays.
std::optional<double> value(const Encoded& encoded, const std::string& metric) {
  if (metric == "bvh_memory") return encoded.bytes;
  return per_ray(encoded.work.counts, metric);
}

bool is_time(const std::string& metric) {
  return metric.starts_with("time");
}

/// Seconds of each run.
const std::vector<double>& times(const Encoded& encoded, const std::string& metric) {
  return metric == "time_lut" ? encoded.seconds_with_table : encoded.work.seconds;
}

/// For times the float value is 1.
void fill_times(const SceneResult& scene, const std::string& metric, ResultRow& row) {
  row.ours[0] = 1.0;
  row.intervals.resize(encodings.size());
  for (std::size_t i = 1; i < encodings.size(); ++i) {
    const ref::Middle ratio =
        ref::middle_ratio(times(scene.by_encoding.at(i), metric), times(scene.by_encoding[0], metric));
    row.ours[i] = 100.0 * (ratio.median - 1.0);
    row.intervals[i] = percent_more(ratio);
  }
  drop_empty_intervals(row);
}

/// The float value, then memory as a value and everything else as an increase in percent.
void fill_ours(const SceneResult& scene, const std::string& metric, ResultRow& row) {
  if (is_time(metric)) return fill_times(scene, metric, row);
  const std::optional<double> plain = value(scene.by_encoding[0], metric);
  if (!plain) return;
  row.ours[0] = *plain;
  for (std::size_t i = 1; i < encodings.size(); ++i) {
    const Encoded& of = scene.by_encoding.at(i);
    const double encoded = *value(of, metric);
    row.ours[i] = metric == "bvh_memory" ? encoded : 100.0 * (encoded / *plain - 1.0);
    if (metric == "bvh_memory") continue;
    const GroupedRatio factor =
        ratio_by_tile(scene.batches, kind_of(metric), count_of(metric), of.work, scene.by_encoding[0].work);
    row.intervals.resize(encodings.size());
    row.intervals[i] = increase_interval(factor);
  }
}

std::vector<std::optional<double>> printed_figures(const PrintedRow& row, const std::string& metric) {
  if (metric == "bvh_memory") return {row.number("fp32"), row.number("int4_abs"), row.number("int8_abs")};
  if (is_time(metric)) return {1.0, row.number("int4_pct"), row.number("int8_pct")};
  return {row.number("fp32"), row.number("int4_pct"), row.number("int8_pct")};
}

/// The least and the most of an encoding's increases, over the rows whose metric contains `part` and that
/// were measured.
Finding least_and_most(const ResultTable& table, const std::string& claim, std::string_view part,
                       std::size_t column, std::string why = {}) {
  Finding finding{claim, {}, std::move(why)};
  const auto row_where = [&](auto better, bool printed) {
    const ResultRow* best = nullptr;
    const auto figure = [&](const ResultRow& row) { return *(printed ? row.printed : row.ours)[column]; };
    for (const ResultRow& row : table.rows) {
      if (row.labels[1].find(part) == std::string::npos || !row.ours[column] || !row.printed[column])
        continue;
      if (best == nullptr || better(figure(row), figure(*best))) best = &row;
    }
    return best;
  };
  const auto add = [&](const std::string& which, auto better) {
    const ResultRow* const ours = row_where(better, false);
    if (ours == nullptr) return;
    Comparison& figure = finding.figures.emplace_back(
        Comparison{fmt::format("{} at {}, %", which, table.columns[column].name),
                   *row_where(better, true)->printed[column], *ours->ours[column], half_percent});
    if (!ours->intervals.empty()) figure.interval = ours->intervals[column];
  };
  add("least", std::less<>());
  add("most", std::greater<>());
  return finding;
}

/// How much smaller an encoding's nodes are together.
Comparison memory_saved(const ResultTable& table, std::size_t column) {
  const auto saved = [&](const std::vector<std::optional<double>>& figures) {
    return 100 * (1 - *figures[column] / *figures[0]);
  };
  for (const ResultRow& row : table.rows)
    if (row.labels[1] == "bvh_memory" && row.ours[0])
      return {fmt::format("memory saved at {}, %", table.columns[column].name), saved(row.printed),
              saved(row.ours), half_percent};
  return {};
}

/// The time of single rays, by scene, from Tables 5.1 and 5.2: bundles of 64 are compared with it.
double printed_single_seconds(const std::string& scene) {
  for (const char* const number : {"5.1", "5.2"})
    if (const PrintedRow* row = printed_table(number).find({scene, "time"})) return *row->number("fp32");
  throw std::logic_error("no printed time of " + scene);
}

using BundleSpeedups = std::vector<std::pair<double, double>>;  // printed and ours, by scene

std::vector<Finding> chapter_5_findings(const ResultTable& table, const BundleSpeedups& bundled) {
  const bool has_tests = table.number != "5.7";
  const bool single = bundle_of(table.number) == 1;
  std::vector<Finding> all;
  if (single) {
    all.push_back(
        {"8 bits save 63 % of the memory, 4 bits 75 %", {memory_saved(table, 2), memory_saved(table, 1)}});
  }
  if (has_tests) {
    for (const auto& [claim, column] : {std::pair("8 bits cost 0 to 4 % more tests", std::size_t{2}),
                                        std::pair("4 bits cost 4 to 32 % more tests", std::size_t{1})}) {
      Finding tests = least_and_most(table, claim, "tests", column);
      if (!tests.figures.empty() && tests.worst().ours > tests.worst().printed) tests.why = starts_inside;
      all.push_back(std::move(tests));
    }
  }
  const std::string less_work =
      single ? "our times leave out shading, so decoding is a larger share of them"
             : "our times leave out shading, and in a smaller image the rays of a bundle are less alike";
  const std::string times =
      single ? "for single rays decoding takes much time" : "bundles make decoding cheap";
  all.push_back(least_and_most(table, times + ", 8 bits", "time", 2, less_work));
  all.push_back(least_and_most(table, times + ", 4 bits", "time", 1, less_work));
  if (!bundled.empty()) {
    const auto less = [](const auto& of) {
      return [of](const auto& a, const auto& b) { return a.*of < b.*of; };
    };
    const auto ours =
        std::minmax_element(bundled.begin(), bundled.end(), less(&BundleSpeedups::value_type::second));
    const auto printed =
        std::minmax_element(bundled.begin(), bundled.end(), less(&BundleSpeedups::value_type::first));
    all.push_back({"bundles of 64 are 44 to 89 % faster than single rays",
                   {{"least, binary32, %", printed.first->first, ours.first->second, half_percent},
                    {"most, binary32, %", printed.second->first, ours.second->second, half_percent}},
                   less_work});
  }
  std::erase_if(all, [](const Finding& finding) { return finding.figures.empty(); });
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
  table.columns = {{"fp32", 3, 0.0005}, {"int4", 1, half_percent}, {"int8", 1, half_percent}};
  std::uint64_t rays = 0;
  std::uint64_t different = 0;
  BundleSpeedups bundled;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const std::optional<Scene> scene = test_scene(scenes[i], options);
    table.notes.push_back(scene_note(scenes[i], scene));
    std::optional<SceneResult> result;
    if (scene) result = run(*scene, bundle, options);
    for (const PrintedRow& thesis : printed.rows()) {
      if (thesis.text("scene") != scenes[i]) continue;
      const std::string& metric = thesis.text("metric");
      ResultRow& row = table.rows.emplace_back(
          ResultRow{.labels = {scenes[i], metric}, .ours = {}, .printed = printed_figures(thesis, metric)});
      row.ours.resize(encodings.size());
      if (is_time(metric)) row.unit = 0;
      if (result) fill_ours(*result, metric, row);
    }
    if (result) {
      for (const Encoded& encoded : result->by_encoding) {
        rays += encoded.work.counts.total().rays;
        different += encoded.work.different;
      }
      if (!result->single_seconds.empty())
        bundled.emplace_back(
            100 *
                (printed_single_seconds(scenes[i]) / *printed.find({scenes[i], "time"})->number("fp32") - 1),
            100 *
                (ref::middle_ratio(result->single_seconds, result->by_encoding[0].work.seconds).median - 1));
    }
    options.progress(static_cast<double>(i + 1) / static_cast<double>(scenes.size()));
  }
  if (rays > 0) table.findings = chapter_5_findings(table, bundled);
  table.notes.push_back(
      fmt::format("bvh_memory in bytes; time: binary32 is 1, traversal alone, the median of {} runs on one "
                  "thread; {} of {} "
                  "answers of Moeller-Trumbore differ from the exact test's",
                  options.repeats, different, rays));
  table.notes.push_back(
      "+-95 %: the interval by the spread among the tiles of the image; of times by the order of the runs");
  return table;
}

}  // namespace hitpipe::thesis
