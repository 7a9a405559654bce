// Judges a box test against the exact referee over the adversary's categories. The cases of a category follow
// from the seed and its place in the list. More tests go on with the same cases, and threads change nothing.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sim/check/shares.hpp"
#include "sim/software/box_software.hpp"
#include "sw_ref/judge/adversary/case.hpp"
#include "sw_ref/judge/adversary/categories.hpp"
#include "sw_ref/judge/interval.hpp"

namespace hitpipe::sim {

using CheckOptions = CheckOptionsOf<ref::adversary::Category>;

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
