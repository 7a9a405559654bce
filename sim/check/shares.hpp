// How the tests of a check are divided among categories, and into batches that threads take.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

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

}  // namespace hitpipe::sim
