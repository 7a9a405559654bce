#include "sim/check/check.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <stdexcept>

#include "sim/check/shares.hpp"
#include "sim/unit/drive.hpp"
#include "sw_ref/judge/adversary/categories.hpp"

namespace hitpipe::sim {

using ref::adversary::Case;
using ref::adversary::Category;
using ref::adversary::Random;

namespace {

void count(const ref::Ray& ray, std::span<const ref::Aabb> boxes, std::span<const bool> hits,
           std::span<const bool> meets, CategoryResult& result) {
  std::uint64_t met = 0;
  std::uint64_t false_hits = 0;
  std::uint64_t false_misses = 0;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    met += meets[i] ? 1 : 0;
    false_hits += hits[i] && !meets[i] ? 1 : 0;
    false_misses += meets[i] && !hits[i] ? 1 : 0;
  }
  result.tests += boxes.size();
  result.hits += met;
  result.false_hits += false_hits;
  result.false_misses += false_misses;
  result.false_miss_share.add(static_cast<double>(false_misses), static_cast<double>(met));
  result.false_hit_share.add(static_cast<double>(false_hits), static_cast<double>(boxes.size() - met));
  for (std::size_t i = 0; false_misses > 0 && !result.false_miss; ++i) {
    if (meets[i] && !hits[i]) result.false_miss = Case{ray, boxes[i]};
  }
}

/// The first `tests` of a batch: what is drawn does not depend on how many are judged.
CategoryResult judge_batch(BoxTest& test, const Category& category, std::uint64_t seed, std::uint64_t tests,
                           Model* rtl) {
  Random random(seed);
  std::vector<ref::Ray> rays;
  std::vector<ref::Aabb> boxes(tests_per_batch);
  for (std::size_t i = 0; i * objects_per_ray < tests; ++i) {
    const Case c = category.make(random);
    rays.push_back(c.ray);
    ref::adversary::neighbours(random, c.box, {boxes.data() + i * objects_per_ray, objects_per_ray});
  }
  CategoryResult result;
  result.category = category.name;
  TestBatch batch;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const std::size_t first = i * objects_per_ray;
    const std::size_t boxes_of_ray = std::min(objects_per_ray, static_cast<std::size_t>(tests) - first);
    const std::span<const ref::Aabb> asked(boxes.data() + first, boxes_of_ray);
    std::array<bool, objects_per_ray> hit_by{};
    std::array<bool, objects_per_ray> met_by{};
    const std::span<bool> hits(hit_by.data(), boxes_of_ray);
    const std::span<bool> meets(met_by.data(), boxes_of_ray);
    test.start(rays[i]);
    if (rtl == nullptr) {
      test.hits(asked, hits);
    } else {
      for (std::size_t box = 0; box < asked.size(); ++box) {
        hits[box] = test.hit(asked[box]);
        batch.add(test.operands(), test.results());
      }
    }
    test.meet(rays[i], asked, meets);
    count(rays[i], asked, hits, meets, result);
  }
  if (rtl != nullptr) result.rtl_mismatches = drive(*rtl, batch).faults();
  return result;
}

}  // namespace

CategoryResult& CategoryResult::operator+=(const CategoryResult& later) {
  tests += later.tests;
  hits += later.hits;
  false_misses += later.false_misses;
  false_hits += later.false_hits;
  rtl_mismatches += later.rtl_mismatches;
  false_miss_share += later.false_miss_share;
  false_hit_share += later.false_hit_share;
  if (!false_miss) false_miss = later.false_miss;
  return *this;
}

std::vector<CategoryResult> check(const MakeBoxTest& make, const CheckOptions& options) {
  return judge_by_category<CategoryResult>(options, make, judge_batch, &CategoryResult::false_miss);
}

bool is_false_miss(BoxTest& test, const Case& c) {
  test.start(c.ray);
  return !test.hit(c.box) && test.meets(c.ray, c.box);
}

}  // namespace hitpipe::sim
