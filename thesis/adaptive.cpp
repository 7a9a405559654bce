#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "area_model/price.hpp"
#include "rays/trace/walk.hpp"
#include "sw_ref/render/recording.hpp"
#include "sw_ref/trace/int_slabs.hpp"
#include "thesis/adaptive_slabs.hpp"
#include "thesis/proposals.hpp"

namespace hitpipe::thesis {

namespace {

using ref::IntBox;
using ref::RecordedBatch;

constexpr std::array<hls::IntBits, 5> small_formats{{{8, 8}, {10, 10}, {12, 12}, {14, 14}, {16, 16}}};
constexpr std::array<hls::IntBits, 2> large_formats{{{24, 24}, {20, 24}}};

/// Asked tests over all tests, by small format: with three answers, and with two, where every hit is asked.
struct Asked {
  std::array<ref::GroupedRatio, small_formats.size()> three;
  std::array<ref::GroupedRatio, small_formats.size()> two;
};

std::vector<IntBox> boxes_of(const ref::Bvh& bvh, int coord_bits) {
  std::vector<ref::Aabb> boxes(bvh.nodes.size());
  std::transform(bvh.nodes.begin(), bvh.nodes.end(), boxes.begin(),
                 [](const ref::BvhNode& node) { return node.box; });
  std::vector<IntBox> quantised(boxes.size());
  ref::quantise_boxes(boxes, coord_bits, quantised);
  return quantised;
}

/// The large unit steers the traversal: it has the last word, and a sure answer is its answer too.
class Measured {
 public:
  Measured(const ref::Mesh& mesh, const ref::Bvh& bvh)
      : mesh_(mesh), bvh_(bvh), large_(boxes_of(bvh, large_formats[0].coord)) {
    for (const hls::IntBits& bits : small_formats) small_.push_back(boxes_of(bvh, bits.coord));
  }

  void trace(const ref::Ray& ray, ref::Query query) {
    ref::IntSlabsTest large(ray, large_formats[0]);
    std::vector<AdaptiveSlabs> small;
    for (const hls::IntBits& bits : small_formats) small.emplace_back(ray, bits);
    ref::BoxWalk traversal(bvh_, ref::FloatWorld(mesh_, bvh_, ray), query);
    float length = traversal.length();
    while (!traversal.done()) {
      const std::uint32_t node = traversal.node();
      tests_ += 1;
      for (std::size_t i = 0; i < small.size(); ++i) {
        const Answer answer = small[i](small_[i][node]);
        three_.at(i) += answer == Answer::ask ? 1 : 0;
        two_.at(i) += answer == Answer::miss ? 0 : 1;
      }
      traversal.answer(large(large_[node]));
      if (traversal.length() == length) continue;
      length = traversal.length();
      large.cut(length);
      for (AdaptiveSlabs& unit : small) unit.cut(length);
    }
  }

  /// Adds what was counted since the last call as a group.
  void end_group(Asked& asked) {
    for (std::size_t i = 0; i < small_formats.size(); ++i) {
      asked.three.at(i).add(three_.at(i), tests_);
      asked.two.at(i).add(two_.at(i), tests_);
    }
    tests_ = 0;
    three_ = {};
    two_ = {};
  }

 private:
  const ref::Mesh& mesh_;
  const ref::Bvh& bvh_;
  std::vector<IntBox> large_;
  std::vector<std::vector<IntBox>> small_;
  double tests_ = 0;
  std::array<double, small_formats.size()> three_{};
  std::array<double, small_formats.size()> two_{};
};

Asked measure(const ref::Scene& scene, const ExperimentOptions& options) {
  const ref::Bvh bvh = ref::build_bvh(scene.mesh);
  Measured measured(scene.mesh, bvh);
  Asked asked;
  for (const RecordedBatch& batch : ref::record_rays(scene, bvh, options.width, options.height, 1)) {
    if (batch.kind == ref::RayKind::primary) measured.end_group(asked);  // the first of a tile
    for (const ref::Ray& ray : batch.rays) measured.trace(ray, batch.query);
  }
  measured.end_group(asked);
  return asked;
}

/// Area times stage delay of the thesis's integer slabs.
double cost(hls::IntBits bits) {
  static const rtl::Design& slabs = rtl::find_design(area::table_7_2()[2].design);
  const Format format = slabs.parse_format(fmt::format("{}/{}", bits.coord, bits.interval));
  return static_cast<double>(
      area::price(slabs, format, rtl::Library::thesis(), area::Account::built).area_delay_per_box());
}

ResultRow row_of(const std::string& scene, const std::string& what) {
  return {.labels = {scene, what},
          .ours = {},
          .printed = std::vector<std::optional<double>>(small_formats.size())};
}

void add_rows(ResultTable& table, const std::string& scene, const Asked& asked) {
  const auto shares = [&](const std::string& what, const auto& ratios) {
    ResultRow row = row_of(scene, what);
    for (const ref::GroupedRatio& ratio : ratios) {
      const ref::Interval of = ratio.share_interval();
      row.ours.emplace_back(100 * ratio.ratio());
      row.intervals.emplace_back(ref::Interval{100 * of.low, 100 * of.high});
    }
    table.rows.push_back(std::move(row));
  };
  shares("asked", asked.three);
  shares("asked, two answers", asked.two);
  for (const hls::IntBits& large : large_formats) {
    // The bounds from the other side take the multipliers of a second unit, or, at best, nothing.
    for (const int units : {1, 2}) {
      ResultRow row =
          row_of(scene, fmt::format("area x time of {}/{}, {} n1", large.coord, large.interval, units));
      for (std::size_t i = 0; i < small_formats.size(); ++i)
        row.ours.emplace_back(100 *
                              (units * cost(small_formats.at(i)) / cost(large) + asked.three.at(i).ratio()));
      table.rows.push_back(std::move(row));
    }
  }
}

}  // namespace

ResultTable adaptive_precision(std::string_view number, const ExperimentOptions& options) {
  ResultTable table;
  table.number = number;
  table.title = "Adaptive precision: % of box tests asked again after n1 bits; cost in %";
  table.labels = {"scene", "figure"};
  for (const hls::IntBits& bits : small_formats)
    table.columns.push_back({fmt::format("{}/{}", bits.coord, bits.interval), 1});
  const std::vector<std::string> scenes = proposal_scenes(number, options);
  for (const std::string& name : scenes) {
    options.progress(static_cast<double>(&name - scenes.data()) / static_cast<double>(scenes.size()));
    add_rows(table, name, measure(proposal_scene(name, options), options));
  }
  options.progress(1.0);
  table.notes = {fmt::format("{} x {} pixels, all rays; one 24/24 unit steers the traversal", options.width,
                             options.height),
                 "area x time: integer slabs of n1 bits for each test, and the asked share of a unit of n2 "
                 "bits, of one unit "
                 "of n2 bits = 100 %. A sure hit needs bounds from the other side: with '1 n1' they cost "
                 "nothing, with '2 n1' "
                 "a second unit of n1 bits",
                 "two answers: a unit that knows no sure hit asks for every hit",
                 "+-95 %: the interval by the spread among the tiles of the image"};
  return table;
}

}  // namespace hitpipe::thesis
