// Set-up of the float unit that never misses: every bound is the tightest number of its format, by rational
// arithmetic, over all categories of the adversary.
#include "sw_ref/quantise/fp_slabs_safe_ray.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "sw_ref/quantise/fp_box.hpp"
#include "tests/message_of.hpp"
#include "tests/rays/exact/rational.hpp"
#include "tests/sw_ref/judge/adversary/each_case.hpp"

namespace hitpipe::ref::fp_slabs_safe_ray_test {
namespace {

using hls::FpBits;
using oracle::exact;
using oracle::Rational;

constexpr std::uint64_t seed = 20091;
const std::vector<FpBits> formats{{8, 23}, {8, 15}, {8, 7}, {5, 10}, {6, 13}, {3, 2}, {2, 1}, {4, 23}};

Rational power_of_two(int exponent) {
  const Rational power(oracle::Integer(1) << static_cast<unsigned>(std::abs(exponent)));
  return exponent < 0 ? Rational(1) / power : power;
}

/// What a pattern without sign stands for; infinity counts as the number after the largest.
Rational number(std::int64_t pattern, const FpBits& bits) {
  const auto field = static_cast<int>(pattern >> bits.fraction);
  const std::int64_t implicit = std::int64_t{1} << bits.fraction;
  const std::int64_t fraction = pattern % implicit;
  const Rational significand(field == 0 ? fraction : implicit + fraction);
  return significand * power_of_two(std::max(field, 1) - bits.bias() - bits.fraction);
}

/// pattern is the last one whose number is not above x.
void expect_last_below(std::int64_t pattern, const Rational& x, const FpBits& bits) {
  ASSERT_LE(number(pattern, bits), x);
  if (pattern + 1 < bits.infinity()) {
    ASSERT_GT(number(pattern + 1, bits), x);
  }
}
/// pattern is the first one whose number is not below x, or infinity if there is none.
void expect_first_above(std::int64_t pattern, const Rational& x, const FpBits& bits) {
  if (pattern < bits.infinity()) {
    ASSERT_GE(number(pattern, bits), x);
  }
  ASSERT_LT(number(pattern - 1, bits), x);
}

Rational scale_of(const Ray& ray) {
  const Rational largest =
      exact(std::max({std::abs(ray.direction.x), std::abs(ray.direction.y), std::abs(ray.direction.z)}));
  int s = -150;
  while (power_of_two(s) < largest) ++s;
  return power_of_two(s);
}

void expect_bounds(const Ray& ray, const FpBits& bits) {
  const FpSlabsSafeRaySetup set_up(ray, bits);
  const FpSlabsSafeRay& r = set_up.ray();
  const Rational scale = scale_of(ray);
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    const float d = ray.direction[axis];
    ASSERT_EQ(r.back[i], std::signbit(d));
    const float origin = r.back[i] ? -ray.origin[axis] : ray.origin[axis];
    ASSERT_LE(r.origin_low[i], origin);
    ASSERT_GE(r.origin_high[i], origin);
    // Neighbours in the format, or the same number.
    const std::int64_t low = fp_pattern(std::abs(r.origin_low[i]), bits);
    const std::int64_t high = fp_pattern(std::abs(r.origin_high[i]), bits);
    ASSERT_LE(std::abs(low - high), r.origin_low[i] == origin ? 0 : 1);
    if (d == 0.0F) {
      ASSERT_EQ(r.inverse_low[i], bits.infinity());
      ASSERT_EQ(r.inverse_high[i], bits.infinity());
      continue;
    }
    const Rational inverse = scale / exact(std::abs(d));
    ASSERT_GE(r.inverse_low[i], bits.one());
    ASSERT_LT(r.inverse_low[i], bits.infinity());
    expect_last_below(r.inverse_low[i], inverse, bits);
    expect_first_above(r.inverse_high[i], inverse * (1 + power_of_two(-bits.fraction)), bits);
  }
  const FpSlabsSafeEnd end = set_up.end(ray.length);
  if (ray.is_infinite()) {
    ASSERT_TRUE(end.endless);
    return;
  }
  const Rational length = exact(ray.length) * scale;
  ASSERT_EQ(end.endless, length >= power_of_two(bits.bias() + 1));
  if (!end.endless) expect_last_below(end.length, length, bits);
}

/// `plane` is the magnitude of a plane and `rounded` the rounded plane: the next number of the format towards
/// zero, or away from it.
void expect_next_outside(float rounded, const Rational& plane, bool towards_zero, const FpBits& bits) {
  const std::int64_t pattern = fp_pattern(std::abs(rounded), bits);
  ASSERT_EQ(number(pattern, bits), exact(std::abs(rounded)));
  towards_zero ? expect_last_below(pattern, plane, bits) : expect_first_above(pattern, plane, bits);
}

TEST(FpSlabsSafeRaySetup, IsTheTightestBoundInEveryFormatAndCategory) {
  adversary::Random random(seed);
  for (const FpBits& bits : formats)
    adversary::each_case(random, 60, [&](const adversary::Case& c) { expect_bounds(c.ray, bits); });
}

TEST(FpRounding, PutsEachPlaneOnTheNextNumberOutside) {
  adversary::Random random(seed);
  for (const FpBits& bits : formats) {
    adversary::each_case(random, 60, [&](const adversary::Case& c) {
      const Aabb rounded = round_box(c.box, bits);
      for (int axis = 0; axis < 3; ++axis) {
        // The sign of a zero counts too.
        ASSERT_TRUE(rounded.min[axis] != 0.0F || std::signbit(rounded.min[axis]));
        ASSERT_TRUE(rounded.max[axis] != 0.0F || !std::signbit(rounded.max[axis]));
        const float min = c.box.min[axis];
        const float max = c.box.max[axis];
        expect_next_outside(rounded.min[axis], exact(std::abs(min)), min >= 0, bits);
        expect_next_outside(rounded.max[axis], exact(std::abs(max)), max <= 0, bits);
      }
    });
  }
}

TEST(FpRounding, RefusesBoxesOutsideTheCube) {
  EXPECT_EQ(message_of<std::out_of_range>([] {
              (void)round_box({glm::vec3(-1), glm::vec3(1.5F)}, {8, 23});
            }),
            "round_box: x = 1.5; boxes must lie within [-1, 1]");
  EXPECT_EQ(message_of<std::invalid_argument>([] {
              (void)round_box({glm::vec3(0), glm::vec3(0)}, {9, 23});
            }),
            "there is no float format e9m23");
}

}  // namespace
}  // namespace hitpipe::ref::fp_slabs_safe_ray_test
