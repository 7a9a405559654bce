// Tables 4.1, 4.3 and 4.4: the same rays through the same hierarchy by each traversal algorithm.
#include <algorithm>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "sw_ref/render/recording.hpp"
#include "thesis/printed.hpp"
#include "thesis/tables.hpp"
#include "thesis/test_scene.hpp"

namespace hitpipe::thesis {
namespace {

struct Contender {
  Algorithm algorithm;
  std::string_view name;
  std::string_view printed_column;
};

constexpr Contender slabs{Algorithm::slabs, "Slabs", "bvh_slabs_time_s"};
constexpr Contender plu{Algorithm::plu, "Plu", "bvh_plu_time_s"};
constexpr Contender slabs_dist{Algorithm::slabs_dist, "Slabs-Dist", "bvh_slabs_dist_time_s"};
constexpr Contender slabs_dsa{Algorithm::slabs_dsa, "Slabs-DSA", "bvh_slabs_dsa_time_s"};
constexpr Contender plu_dsa{Algorithm::plu_dsa, "Plu-DSA", "bvh_plu_dsa_time_s"};

/// The first one's time is 1.
std::vector<Contender> contenders(std::string_view number) {
  if (number == "4.1") return {slabs, plu};
  if (number == "4.3") return {plu, plu_dsa};
  return {slabs, slabs_dist, slabs_dsa, plu_dsa};
}

/// Traced as in the thesis: binary32 box tests, Moeller-Trumbore.
Measurement run(const Scene& scene, const Bvh& bvh, const std::vector<RecordedBatch>& rays,
                Algorithm algorithm, int repeats) {
  TracerOptions options;
  options.algorithm = algorithm;
  options.arithmetic = Arithmetic::binary32;
  options.triangle_test = TriangleTest::binary32;
  return measure(*make_tracer(scene.mesh, bvh, options), rays, repeats);
}

constexpr std::string_view time_row = "time";

/// By how many percent column `a` is faster than column `b`, on the scenes that were measured.
struct Speedups {
  std::vector<double> ours;
  std::vector<double> printed;
};

Speedups speedups(const ResultTable& table, std::size_t a, std::size_t b) {
  Speedups all;
  for (const ResultRow& row : table.rows) {
    if (row.labels[1] != time_row || !row.ours[a] || !row.ours[b]) continue;
    all.ours.push_back(100 * (*row.ours[b] / *row.ours[a] - 1));
    all.printed.push_back(100 * (*row.printed[b] / *row.printed[a] - 1));
  }
  return all;
}

Finding least_and_most(const ResultTable& table, const std::string& claim, std::size_t a, std::size_t b) {
  const Speedups all = speedups(table, a, b);
  const auto least = [](const std::vector<double>& of) { return *std::min_element(of.begin(), of.end()); };
  const auto most = [](const std::vector<double>& of) { return *std::max_element(of.begin(), of.end()); };
  const std::string what = fmt::format("{} faster than {}, %", table.columns[a].name, table.columns[b].name);
  return {claim,
          {{"least: " + what, least(all.printed), least(all.ours), half_percent},
           {"most: " + what, most(all.printed), most(all.ours), half_percent}},
          other_machine};
}

Finding on_average(const ResultTable& table, const std::string& claim, std::size_t a, std::size_t b) {
  const Speedups all = speedups(table, a, b);
  const auto average = [](const std::vector<double>& of) {
    return std::accumulate(of.begin(), of.end(), 0.0) / static_cast<double>(of.size());
  };
  return {claim,
          {{fmt::format("average: {} faster than {}, %", table.columns[a].name, table.columns[b].name),
            average(all.printed), average(all.ours), half_percent}},
          other_machine};
}

std::vector<Finding> chapter_4_findings(const ResultTable& table) {
  const bool measured = std::any_of(table.rows.begin(), table.rows.end(),
                                    [](const ResultRow& row) { return row.ours.front().has_value(); });
  if (!measured) return {};
  if (table.number == "4.1")
    return {least_and_most(table, "Pluecker boxes are faster than slabs, by 9 to 27 %", 1, 0)};
  if (table.number == "4.3")
    return {least_and_most(table, "DSA is up to 233 % faster than a fixed order, and 2 % slower on one scene",
                           1, 0)};
  return {on_average(table, "DSA is as good as the order of distances", 2, 1),
          least_and_most(table, "with DSA, Pluecker is faster than slabs on every scene", 3, 2)};
}

}  // namespace

ResultTable traversal_times(std::string_view number, const ExperimentOptions& options) {
  const PrintedTable& printed = printed_table(number);
  const std::vector<Contender> all = contenders(number);
  const std::vector<std::string> scenes = scenes_of_table(number, options);
  ResultTable table;
  table.number = number;
  table.title = fmt::format("Traversal: time, {} is 1, and box tests per ray", all.front().name);
  table.labels = {"scene", "metric"};
  for (const Contender& contender : all) table.columns.push_back({std::string(contender.name), 2, 0.005});
  std::uint64_t rays = 0;
  std::uint64_t different = 0;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    ResultRow times{.labels = {scenes[i], std::string(time_row)}, .ours = {}, .printed = {}};
    ResultRow boxes{.labels = {scenes[i], "box tests"}, .ours = {}, .printed = {}};
    times.unit = 0;
    for (ResultRow* row : {&times, &boxes}) {
      row->ours.resize(all.size());
      row->printed.resize(all.size());
    }
    const PrintedRow& thesis = *printed.find({scenes[i]});
    for (std::size_t c = 0; c < all.size(); ++c)
      times.printed[c] = *thesis.number(all[c].printed_column) / *thesis.number(all.front().printed_column);
    const std::optional<Scene> scene = test_scene(scenes[i], options);
    table.notes.push_back(scene_note(scenes[i], scene));
    if (scene) {
      const Bvh bvh = build_bvh(scene->mesh);
      const std::vector<RecordedBatch> batches = record_rays(*scene, bvh, options.width, options.height, 1);
      std::vector<double> unit;
      times.intervals.resize(all.size());
      for (std::size_t c = 0; c < all.size(); ++c) {
        const Measurement measurement = run(*scene, bvh, batches, all[c].algorithm, options.repeats);
        if (c == 0) unit = measurement.seconds;
        const TraceCounts total = measurement.counts.total();
        const ref::Middle ratio = ref::middle_ratio(measurement.seconds, unit);
        times.ours[c] = ratio.median;
        if (c > 0) times.intervals[c] = ratio.interval;
        boxes.ours[c] = static_cast<double>(total.box_tests) / static_cast<double>(total.rays);
        rays += total.rays;
        different += measurement.different;
      }
    }
    drop_empty_intervals(times);
    table.rows.push_back(std::move(times));
    table.rows.push_back(std::move(boxes));
    options.progress(static_cast<double>(i + 1) / static_cast<double>(scenes.size()));
  }
  table.findings = chapter_4_findings(table);
  table.notes.push_back(
      fmt::format("{} x {} pixels, all rays, without shading; the median of {} runs on one thread. {} of {} "
                  "rays differ from "
                  "the exact triangle test",
                  options.width, options.height, options.repeats, different, rays));
  if (options.repeats >= runs_of_interval) table.notes.emplace_back(interval_note);
  return table;
}

}  // namespace hitpipe::thesis
