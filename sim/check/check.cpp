#include "sim/check/check.hpp"

#include <algorithm>
#include <array>
#include <mutex>
#include <span>
#include <stdexcept>

#include <oneapi/tbb/enumerable_thread_specific.h>

#include "host/parallel.hpp"
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

/// The results of the batches that have ended, in any order.
class Sums {
 public:
  explicit Sums(const std::vector<Category>& categories)
      : results_(categories.size()), first_misses_(categories.size()) {
    for (std::size_t c = 0; c < categories.size(); ++c) results_[c].category = categories[c].name;
  }

  void add(const Batch& batch, const CategoryResult& result) {
    const std::scoped_lock lock(adding_);
    std::uint64_t& first = first_misses_[batch.category];
    CategoryResult& sum = results_[batch.category];
    if (result.false_miss && (!sum.false_miss || batch.number < first)) {
      first = batch.number;
      sum.false_miss = result.false_miss;
    }
    sum += result;
  }
  [[nodiscard]] std::vector<CategoryResult> results() const { return results_; }

 private:
  std::mutex adding_;
  std::vector<CategoryResult> results_;
  std::vector<std::uint64_t> first_misses_;  // batches of the false misses that are kept
};

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
  const std::size_t categories = options.categories.size();
  if (categories == 0) return {};
  const Shares shares(options.tests, categories);
  const host::Piece::Range mine = options.piece.range(shares.batches());
  Sums sums(options.categories);

  struct Worker {
    std::unique_ptr<BoxTest> test;
    std::optional<Model> rtl;
  };
  oneapi::tbb::enumerable_thread_specific<Worker> workers([&] {
    Worker worker{make(), std::nullopt};
    if (options.rtl != nullptr) worker.rtl.emplace(*options.rtl);
    return worker;
  });
  const auto judge = [&](std::size_t i) {
    Worker& worker = workers.local();
    const Batch batch = shares[mine.first + i];
    sums.add(batch, judge_batch(*worker.test, options.categories[batch.category],
                                stream(options.seed, batch.category, batch.number), batch.tests,
                                worker.rtl ? &*worker.rtl : nullptr));
  };
  host::for_each_index(mine.size(), options.threads, judge, options.progress);
  return sums.results();
}

bool is_false_miss(BoxTest& test, const Case& c) {
  test.start(c.ray);
  return !test.hit(c.box) && test.meets(c.ray, c.box);
}

}  // namespace hitpipe::sim
