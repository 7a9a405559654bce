// Integer Pluecker ray set-up against rational arithmetic, for every n and adversary category.
#include "sw_ref/quantise/int_plucker_ray.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "rays/exact/grid.hpp"
#include "tests/rays/exact/rational.hpp"
#include "tests/sw_ref/judge/adversary/each_case.hpp"

namespace hitpipe::ref::int_plucker_ray_test {
namespace {

using adversary::Random;
using adversary::to_text;
using hls::IntBits;
using oracle::exact;
using oracle::Rational;

constexpr std::uint64_t seed = 20074;
const Rational half = Rational(1) / 2;

/// M d / max |d|, to nearest, ties away from zero.
oracle::Integer expected_direction(const Ray& ray, int axis, int n) {
  const glm::vec3 d = glm::abs(ray.direction);
  const Rational e = direction_limit(n) * exact(d[axis]) / exact(std::max({d.x, d.y, d.z}));
  const oracle::Integer magnitude = oracle::floor(e + half);
  return ray.direction[axis] < 0 ? oracle::Integer(-magnitude) : magnitude;
}

/// Section 6.3.1 in rational numbers; `set_up` has the rounded direction.
IntEndpoint expected_end(const Ray& ray, float length, int n, const IntPluckerRay& set_up) {
  const IntEndpoint nowhere{set_up.origin, true};
  if (std::isinf(length)) return nowhere;
  IntEndpoint end;
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    const Rational o = exact(ray.origin[axis]);
    const Rational e = o + exact(length) * exact(ray.direction[axis]);
    if (e > 1 || e < -1) return nowhere;
    const bool minus = set_up.direction[i] < 0;
    const Rational coordinate = minus ? oracle::floor(grid_scale(n) * std::min(o, e))  //
                                      : oracle::ceil(grid_scale(n) * std::max(o, e));
    end.at[i] = static_cast<std::int32_t>(static_cast<std::int64_t>(numerator(coordinate)));
  }
  return end;
}

/// `other` is a length to which the set-up is cut. Returns whether the ray ends within the cube.
bool expect_rational(const Ray& ray, float other, IntBits bits) {
  SCOPED_TRACE(testing::Message() << bits.coord << " bits, cut at " << other << ": " << to_text(ray));
  const IntPluckerRaySetup set_up(ray, bits);
  const IntPluckerRay& result = set_up.ray();
  const int n = bits.coord;
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    EXPECT_EQ(result.origin[i], oracle::floor(grid_scale(n) * exact(ray.origin[axis]) + half));
    EXPECT_EQ(result.direction[i], expected_direction(ray, axis, n));
    EXPECT_LE(std::abs(std::int64_t{result.end.at[i]}), grid_scale(n));
  }
  EXPECT_EQ(result.end, expected_end(ray, ray.length, n, result));
  EXPECT_EQ(set_up.endpoint(other), expected_end(ray, other, n, result));
  return !result.end.infinite;
}

IntBits any_format(Random& random) {
  const int n = random.between(IntBits::min_coord, IntBits::max_coord);
  return {n, random.between(IntBits::min_interval, 2 * n - 1)};
}

TEST(IntPluckerRaySetup, IsTheRationalInEveryCategory) {
  Random random(seed);
  int run = 0;
  int ends = 0;
  adversary::each_case(random, 2'000, [&](const adversary::Case& c) {
    ++run;
    ends += expect_rational(c.ray, adversary::any_length(random), any_format(random)) ? 1 : 0;
  });
  EXPECT_GT(ends, run / 4);
}

/// Cases in which the terms of the sum lie far apart, cancel, or are both below the last bit of the fixed
/// point.
TEST(IntPluckerRaySetup, EndpointIsTheRationalForAnyExponents) {
  Random random(seed + 1);
  int run = 0;
  int ends = 0;
  while (run < 60'000 && !HasFailure()) {
    Ray ray;
    const int low = random.between(0, 148);
    const auto tiny = [&] { return random.of_exponent(-149, -low - 1); };
    for (int axis = 0; axis < 3; ++axis) {
      ray.origin[axis] = random.below(4) == 0 ? random.signed_unit() : tiny();
      ray.direction[axis] = random.below(4) == 0 ? random.signed_unit() : tiny();
    }
    ray.length = std::abs(random.coin() ? random.signed_unit() : random.of_exponent(-149, low));
    if (random.below(3) == 0) {
      // The ray ends where the axis is 0, or an ulp from there.
      const int axis = random.axis();
      ray.length = std::ldexp(1.0F, -random.between(0, 20));
      ray.direction[axis] = -ray.origin[axis] / ray.length;
      if (random.coin()) ray.direction[axis] = std::nextafter(ray.direction[axis], random.sign());
    }
    if (ray.direction == glm::vec3(0) || !std::isfinite(ray.direction.x + ray.direction.y + ray.direction.z))
      continue;
    ends += expect_rational(ray, 0, any_format(random)) ? 1 : 0;
    ++run;
  }
  EXPECT_GT(ends, run / 2);
}

}  // namespace
}  // namespace hitpipe::ref::int_plucker_ray_test
