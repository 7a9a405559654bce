// Judges a box test against the exact referee over the adversary's categories. The cases of a category follow
// from the seed and its place in the list. More tests go on with the same cases, and threads change nothing.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "host/piece.hpp"
#include "sim/check/box_test.hpp"
#include "sim/unit/verilated_design.hpp"
#include "sw_ref/judge/adversary/case.hpp"
#include "sw_ref/judge/adversary/categories.hpp"
#include "sw_ref/judge/interval.hpp"

namespace hitpipe::sim {

struct CheckOptions {
  std::vector<ref::adversary::Category> categories;  ///< which to draw from
  /// Of all categories, which have equal shares. A remainder goes to the first categories, one test each.
  std::uint64_t tests = 1'000'000;
  std::uint64_t seed = 1;
  host::Piece piece{};  ///< of the batches of tests (shares.hpp); only these are judged
  int threads = 1;
  const VerilatedDesign* rtl =
      nullptr;  ///< answers each test too, when given; the box test has its operands and results
  /// Told the finished share of the tests, 0..1, from any thread.
  std::function<void(double)> progress = [](double) {};
};

struct CategoryResult {
  std::string category;
  std::uint64_t tests = 0;
  std::uint64_t hits = 0;  ///< by the exact referee
  std::uint64_t false_misses = 0;
  std::uint64_t false_hits = 0;
  std::uint64_t rtl_mismatches = 0;
  ref::GroupedRatio false_miss_share;  ///< of the boxes that the ray meets; the boxes of a ray are a group
  ref::GroupedRatio false_hit_share;   ///< of the boxes that the ray misses
  std::optional<ref::adversary::Case> false_miss;  ///< the first, as it was drawn

  CategoryResult& operator+=(const CategoryResult& later);
};

/// One result for each category, in order.
[[nodiscard]] std::vector<CategoryResult> check(const MakeBoxTest& make, const CheckOptions& options);

/// The box test's answer to one case is a false miss.
[[nodiscard]] bool is_false_miss(BoxTest& test, const ref::adversary::Case& c);

}  // namespace hitpipe::sim
