// Every category of the adversary, and a loop over their cases. A failure names the category and the case.
#pragma once

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "sw_ref/judge/adversary/categories.hpp"

namespace hitpipe::ref::adversary {

/// The usual categories, then the categories for units with a major axis and for float units.
[[nodiscard]] inline std::vector<Category> every_category() {
  std::vector<Category> all;
  for (const auto some : {categories(), major_categories(), float_unit_categories()})
    all.insert(all.end(), some.begin(), some.end());
  return all;
}

/// Calls visit(case) `count` times for each category. Stops at the first failure.
template <class Visit>
void each_case(Random& random, int count, const Visit& visit) {
  for (const Category& category : every_category()) {
    for (int i = 0; i < count; ++i) {
      const Case c = category.make(random);
      visit(c);
      if (testing::Test::HasFailure()) FAIL() << category.name << ": " << to_text(c);
    }
  }
}

/// The case at half its size, where coarser axes stay on the grid. The direction stays, because it may be the
/// smallest possible.
[[nodiscard]] inline Case halved(Case c) {
  c.ray.origin *= 0.5F;
  c.ray.length *= 0.5F;
  c.box.min *= 0.5F;
  c.box.max *= 0.5F;
  return c;
}

/// A length of any exponent, or below 1.
[[nodiscard]] inline float any_length(Random& random) {
  return std::abs(random.coin() ? random.signed_unit() : random.of_exponent(-150, 127));
}

/// Any origin, and a direction and a length of any exponents.
[[nodiscard]] inline Ray any_ray(Random& random) {
  Ray ray;
  for (int axis = 0; axis < 3; ++axis) {
    ray.origin[axis] = random.signed_unit();
    ray.direction[axis] = random.of_exponent(-149, 127);
  }
  ray.length = std::abs(random.of_exponent(-150, 127));
  return ray;
}

}  // namespace hitpipe::ref::adversary
