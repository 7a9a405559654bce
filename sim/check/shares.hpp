// How the tests of a check are divided among categories, and into batches that threads judge.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <vector>

#include "host/parallel.hpp"
#include "host/per_thread.hpp"
#include "host/piece.hpp"
#include "sim/unit/verilated_design.hpp"
#include "sw_ref/judge/adversary/random.hpp"

namespace hitpipe::sim {

// A ray is set up once and asked about several boxes or triangles: set-up is the slow part.
inline constexpr std::size_t objects_per_ray = 32;
inline constexpr std::size_t rays_per_batch = 64;  // a batch fits into a core's own cache
inline constexpr std::uint64_t tests_per_batch = objects_per_ray * rays_per_batch;

/// SplitMix64 of the seed, the category and the batch: unrelated streams.
inline std::uint64_t stream(std::uint64_t seed, std::uint64_t category, std::uint64_t batch) {
  return ref::mixed(seed + ref::golden_step * (category * 0x100000001U + batch + 1));
}

/// Where a category's tests lie among all, cut into batches; only a category's last batch is short.
struct Batch {
  std::size_t category;
  std::uint64_t number;  // within its category
  std::uint64_t tests;
};

/// Shares all tests among the categories; the first categories take what is left over.
class Shares {
 public:
  Shares(std::uint64_t tests, std::size_t categories)
      : least_(tests / categories), left_over_(tests % categories), categories_(categories) {}

  [[nodiscard]] std::uint64_t batches() const {
    return left_over_ * batches_of(least_ + 1) + (categories_ - left_over_) * batches_of(least_);
  }
  [[nodiscard]] Batch operator[](std::uint64_t i) const {
    const std::uint64_t larger = left_over_ * batches_of(least_ + 1);
    if (i < larger) return batch(0, i, least_ + 1);
    return batch(left_over_, i - larger, least_);
  }

 private:
  static std::uint64_t batches_of(std::uint64_t share) {
    return (share + tests_per_batch - 1) / tests_per_batch;
  }
  static Batch batch(std::uint64_t first_category, std::uint64_t i, std::uint64_t share) {
    const std::uint64_t number = i % batches_of(share);
    return {static_cast<std::size_t>(first_category + i / batches_of(share)), number,
            std::min(tests_per_batch, share - number * tests_per_batch)};
  }

  std::uint64_t least_;
  std::uint64_t left_over_;  // categories with a test more
  std::uint64_t categories_;
};

/// What a check of boxes or of triangles is asked.
template <class Category>
struct CheckOptionsOf {
  std::vector<Category> categories;  ///< which to draw from
  /// Of all categories, which have equal shares. A remainder goes to the first categories, one test each.
  std::uint64_t tests = 1'000'000;
  std::uint64_t seed = 1;
  host::Piece piece{};  ///< of the batches of tests; only these are judged
  int threads = 1;
  /// Answers each test too, when given; the software test has its operands and results.
  const VerilatedDesign* rtl = nullptr;
  /// Told the finished share of the tests, 0..1, from any thread.
  std::function<void(double)> progress = [](double) {};
};

/// One result for each category, in order. Each thread has a test of its own. judge_batch(test, category, seed,
/// tests, rtl) judges a batch. `first` is the case that a result keeps: that of the lowest batch.
template <class Result, class Category, class Make, class JudgeBatch, class First>
std::vector<Result> judge_by_category(const CheckOptionsOf<Category>& options, const Make& make,
                                      const JudgeBatch& judge_batch, First Result::*first) {
  const std::size_t categories = options.categories.size();
  if (categories == 0) return {};
  const Shares shares(options.tests, categories);
  const host::Piece::Range mine = options.piece.range(shares.batches());
  std::vector<Result> sums(categories);
  for (std::size_t c = 0; c < categories; ++c) sums[c].category = options.categories[c].name;
  std::vector<std::uint64_t> kept(categories);  // batches of the cases that are kept
  std::mutex adding;

  struct Worker {
    decltype(make()) test;
    std::optional<Model> rtl;
  };
  host::PerThread<Worker> workers([&] {
    Worker worker{make(), std::nullopt};
    if (options.rtl != nullptr) worker.rtl.emplace(*options.rtl);
    return worker;
  });
  const auto judge = [&](std::size_t i) {
    Worker& worker = workers.local();
    const Batch batch = shares[mine.first + i];
    const Result result = judge_batch(*worker.test, options.categories[batch.category],
                                      stream(options.seed, batch.category, batch.number), batch.tests,
                                      worker.rtl ? &*worker.rtl : nullptr);
    const std::scoped_lock lock(adding);
    Result& sum = sums[batch.category];
    if (result.*first && (!(sum.*first) || batch.number < kept[batch.category])) {
      kept[batch.category] = batch.number;
      sum.*first = result.*first;
    }
    sum += result;
  };
  host::for_each_index(mine.size(), options.threads, judge, options.progress);
  return sums;
}

}  // namespace hitpipe::sim
