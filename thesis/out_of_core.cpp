// Tables 5.8 and 5.9: a scene whose binary32 hierarchy does not fit memory and whose 8-bit hierarchy does.
// The thesis timed a machine that swapped; here the paging model counts the page faults.
#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "sw_ref/hierarchy/hierarchical_nodes.hpp"
#include "sw_ref/hierarchy/plain_nodes.hpp"
#include "sw_ref/memory/read_bytes.hpp"
#include "sw_ref/render/recording.hpp"
#include "sw_ref/trace/plucker.hpp"
#include "sw_ref/trace/store_tracer.hpp"
#include "thesis/metric.hpp"
#include "thesis/printed.hpp"
#include "thesis/tables.hpp"
#include "thesis/test_scene.hpp"

namespace hitpipe::thesis {
namespace {

/// Memory as a share of what the binary32 form needs. The memory of the thesis's machine held the 8-bit form
/// but not the binary32 form.
constexpr std::array memory_percents{95, 90, 80, 60, 40};

struct Paged {
  RenderCounts counts;
  std::array<std::uint64_t, memory_percents.size()> faults{};
  std::uint64_t bytes = 0;  ///< of the nodes
  std::uint64_t pages = 0;  ///< pages that were read
};

constexpr std::uint32_t page_bytes = 4096;
constexpr std::size_t runs = memory_percents.size() + 1;

/// Page faults are lines that a cache of pages fetches, when all pages are one set. memory_percents are
/// shares of unit_pages; 0 means the pages that this store reads.
template <class Store>
Paged run(const Scene& scene, const Bvh& bvh, const Store& store, const std::vector<RecordedBatch>& batches,
          int bundle, std::uint64_t unit_pages, const std::function<void()>& step) {
  const std::unique_ptr<Tracer> tracer =
      store_tracer(store, TestMaker<Plucker<float>>(), Leaves(scene.mesh, bvh, TriangleTest::binary32),
                   {.bundle = bundle});
  Paged result;
  result.bytes = store.size() * store.bytes_per_node;
  result.counts = measure(*tracer, batches, 1).counts;
  const auto faults = [&](std::uint64_t memory_bytes) {
    const CacheShape pages{
        .bytes = std::max<std::uint64_t>(memory_bytes, page_bytes), .line_bytes = page_bytes, .ways = 0};
    const ReadBytes read =
        read_bytes(*tracer, scene.mesh, bvh, batches, TriangleLayout::indices, {&pages, 1});
    step();
    return read.behind.front() / page_bytes;
  };
  result.pages = faults(std::numeric_limits<std::uint64_t>::max());
  const std::uint64_t unit = unit_pages == 0 ? result.pages : unit_pages;
  for (std::size_t i = 0; i < memory_percents.size(); ++i)
    result.faults.at(i) = faults(unit * static_cast<std::uint64_t>(memory_percents.at(i)) / 100 * page_bytes);
  return result;
}

}  // namespace

ResultTable out_of_core(std::string_view number, const ExperimentOptions& options) {
  const PrintedTable& printed = printed_table(number);
  const int bundle = number == "5.8" ? 1 : 64;
  const std::string name = scenes_of_table(number, options).front();
  const std::optional<Scene> scene = test_scene(name, options);
  ResultTable table;
  table.number = number;
  table.title = fmt::format("Out of core, {}: per ray, then change in %",
                            bundle == 1 ? "single rays" : fmt::format("bundles of {}", bundle));
  table.labels = {"scene", "metric"};
  table.columns = {{"fp32", 3, 0.0005}, {"int8", 1, 0.5}};
  table.notes.push_back(scene_note(name, scene));
  std::optional<std::pair<Paged, Paged>> result;
  if (scene) {
    const Bvh bvh = build_bvh(scene->mesh);
    const std::vector<RecordedBatch> batches =
        record_rays(*scene, bvh, options.width, options.height, bundle);
    double done = 0;
    const auto step = [&] { options.progress(++done / (2.0 * runs)); };
    const Paged plain = run(*scene, bvh, PlainNodes(bvh), batches, bundle, 0, step);
    result.emplace(plain,
                   run(*scene, bvh, HierarchicalNodes<8, true>(bvh), batches, bundle, plain.pages, step));
  }
  const auto change = [](double plain, double encoded) { return 100.0 * (encoded / plain - 1.0); };
  for (const PrintedRow& thesis : printed.rows()) {
    const std::string& metric = thesis.text("metric");
    const bool memory = metric == "bvh_memory";
    ResultRow row{.labels = {name, metric}, .ours = {std::nullopt, std::nullopt}, .printed = {}};
    row.printed = {thesis.number("fp32"), thesis.number(memory ? "int8_abs" : "int8_pct")};
    if (result && memory) {
      row.ours = {static_cast<double>(result->first.bytes), static_cast<double>(result->second.bytes)};
    } else if (result && metric != "time") {
      const std::optional<double> plain = per_ray(result->first.counts, metric);
      if (plain) row.ours = {plain, change(*plain, *per_ray(result->second.counts, metric))};
    }
    table.rows.push_back(std::move(row));
  }
  if (!result) return table;
  const auto rays = static_cast<double>(result->first.counts.total().rays);
  double least_saved = 100;
  const auto plain_pages = static_cast<double>(result->first.pages);
  table.rows.push_back({.labels = {name, "pages read from"},
                        .ours = {plain_pages, change(plain_pages, static_cast<double>(result->second.pages))},
                        .printed = {std::nullopt, std::nullopt}});
  for (std::size_t i = 0; i < memory_percents.size(); ++i) {
    const double plain = static_cast<double>(result->first.faults.at(i)) / rays;
    const double encoded = static_cast<double>(result->second.faults.at(i)) / rays;
    least_saved = std::min(least_saved, -change(plain, encoded));
    table.rows.push_back({.labels = {name, fmt::format("page faults, {} % memory", memory_percents.at(i))},
                          .ours = {plain, change(plain, encoded)},
                          .printed = {std::nullopt, std::nullopt}});
  }
  Finding tests{"8 bits cost 1 % more tests", {}, starts_inside};
  for (const ResultRow& row : table.rows) {
    if (row.labels[1].find("tests") == std::string::npos || !row.ours[1] || !row.printed[1]) continue;
    tests.figures.push_back({row.labels[1] + ", %", *row.printed[1], *row.ours[1], 0.5});
  }
  if (!tests.figures.empty()) table.findings.push_back(tests);
  const PrintedRow& time = *printed.find({name, "time"});
  table.findings.push_back(
      {"where binary32 does not fit into memory and 8 bits do, 8 bits take far less time",
       {{"least saved at 95 to 40 % memory, %", -*time.number("int8_pct"), least_saved, 0.5}},
       "ours are page faults and the thesis's are seconds: no run here swapped"});
  table.notes.push_back(fmt::format(
      "bvh_memory in bytes. Memory in % of all that the binary32 form reads from; {}-byte pages, least "
      "recently used "
      "out first; {} x {} pixels. The thesis's time is of a machine that swapped; no run here swapped",
      page_bytes, options.width, options.height));
  return table;
}

}  // namespace hitpipe::thesis
