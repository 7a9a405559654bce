// Ray set-up of the units with a major axis against rational arithmetic, for every n and g, with a test for
// each of its corners.
#include "rays/world/int_major_ray.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

#include "rays/exact/grid.hpp"
#include "sw_ref/judge/adversary/parts.hpp"
#include "tests/rays/exact/rational.hpp"
#include "tests/sw_ref/judge/adversary/each_case.hpp"
#include "tests/sw_ref/quantise/major_formats.hpp"

namespace hitpipe::ref::int_major_ray_test {
namespace {

using adversary::nudged;
using adversary::Random;
using adversary::vector_of;
using hls::MajorBits;
using oracle::exact;
using oracle::Integer;
using oracle::Rational;
using Axes = std::array<int, 3>;
using Triple = std::array<std::int64_t, 3>;

constexpr std::uint64_t seed = 20081;

Rational power_of_two(int exponent) {
  const Rational power = Integer(1) << static_cast<unsigned>(std::abs(exponent));
  return exponent < 0 ? Rational(1) / power : power;
}

/// The first axis of the largest component.
int major_of(const glm::vec3& d) {
  const glm::vec3 size = glm::abs(d);
  if (size.x >= size.y && size.x >= size.z) return 0;
  return size.y >= size.z ? 1 : 2;
}

/// The smallest exponent for which the upper bound of |D_M| / |D_k| has p bits.
MajorQuotient expected_quotient(float major, float other, MajorBits bits) {
  const Integer largest = (Integer(1) << static_cast<unsigned>(bits.mantissa)) - 1;
  const auto most = static_cast<std::uint32_t>(largest);
  const int cap = bits.coord + bits.finer - 1;
  if (other == 0) return {most, most, cap};
  const Rational full = exact(std::abs(major)) / exact(std::abs(other)) * power_of_two(bits.mantissa - 1);
  for (int e = 0; e <= cap; ++e) {
    const Rational q = full * power_of_two(-e);
    if (oracle::ceil(q) <= largest)
      return {static_cast<std::uint32_t>(oracle::floor(q)), static_cast<std::uint32_t>(oracle::ceil(q)), e};
  }
  return {most, most, cap};
}

std::int64_t expected_length(float length, float major, MajorBits bits) {
  const std::int64_t largest = (std::int64_t{1} << (bits.coord + bits.fraction - 1)) - 1;
  if (std::isinf(length)) return largest;
  const Rational full =
      exact(length) * exact(std::abs(major)) * grid_scale(bits.coord) * power_of_two(bits.fraction);
  return static_cast<std::int64_t>(std::min(oracle::floor(full), Integer(largest)));
}

/// `other` is a length to which the set-up is cut.
void expect_rational(const Ray& ray, float other, MajorBits bits) {
  SCOPED_TRACE(name_of(bits) + ": " + adversary::to_text(ray));
  const IntMajorRaySetup set_up(ray, bits);
  const IntMajorRay& result = set_up.ray();
  const int major = major_of(ray.direction);
  Axes axes{0, 1, 2};
  std::swap(axes[0], axes[static_cast<std::size_t>(major)]);
  ASSERT_EQ(result.axes, axes);
  const Rational half = Rational(1) / 2;
  for (std::size_t ray_axis = 0; ray_axis < 3; ++ray_axis) {
    const bool backward = ray.direction[axes[ray_axis]] < 0;
    ASSERT_EQ(result.backward[ray_axis], backward);
    // In the mirrored world, where a tie goes down.
    const Rational mirrored = (backward ? -1 : 1) * exact(ray.origin[axes[ray_axis]]) *
                              grid_scale(bits.coord) * power_of_two(bits.finer);
    const Integer nearest = oracle::ceil(mirrored - half);
    ASSERT_EQ(result.origin[ray_axis], backward ? nearest - 1 : nearest) << "ray axis " << ray_axis;
    ASSERT_LE(std::abs(result.origin[ray_axis] + (backward ? 1 : 0)), grid_scale(bits.coord) << bits.finer);
    if (ray_axis == 0) continue;
    ASSERT_EQ(result.quotient[ray_axis - 1],
              expected_quotient(ray.direction[major], ray.direction[axes[ray_axis]], bits))
        << "ray axis " << ray_axis;
  }
  for (const float length : {ray.length, other})
    ASSERT_EQ(set_up.length(length), expected_length(length, ray.direction[major], bits)) << length;
}

MajorBits any_format(Random& random) {
  return major_bits(random, random.between(MajorBits::min_proved_coord, MajorBits::max_coord),
                    random.between(0, MajorBits::max_finer));
}

TEST(IntMajorRaySetup, IsTheRationalInEveryCategory) {
  Random random(seed);
  adversary::each_case(random, 500, [&](const adversary::Case& c) {
    expect_rational(c.ray, adversary::any_length(random), any_format(random));
  });
}

/// Components 2^e apart with mantissas that are alike, or ends of their range: e about the largest exponent,
/// and quotients about 2.
glm::vec3 direction_at_corners(Random& random, MajorBits bits) {
  const auto mantissa = [&] {
    switch (random.below(4)) {
      case 0:
        return 1.0F;
      case 1:
        return nudged(1.0F, random.between(1, 3));
      case 2:
        return nudged(2.0F, -random.between(1, 3));
      default:
        return 2.0F - std::ldexp(1.0F, -random.between(bits.mantissa - 2, bits.mantissa + 1));
    }
  };
  const int cap = bits.coord + bits.finer - 1;
  const auto exponent = [&] { return random.coin() ? cap + random.between(-2, 2) : random.between(0, cap); };
  const int fast = random.axis();
  const int first = random.between(-100, 120);
  glm::vec3 d{0};
  for (int axis = 0; axis < 3; ++axis) {
    const int less = axis == fast ? 0 : exponent();
    d[axis] = random.sign() * std::ldexp(mantissa(), first - less);
    if (axis != fast && random.below(8) == 0) d[axis] = random.signed_zero();
    if (axis != fast && random.below(8) == 0) d[axis] = random.sign() * d[fast];
  }
  return d;
}

/// The origin's grid has ties at the odd multiples of 2^-(g+1), for G is odd.
float at_a_tie(Random& random, int finer) {
  const int steps = 1 << (finer + 1);
  return std::ldexp(static_cast<float>(2 * random.between(0, steps / 2 - 1) + 1), -(finer + 1)) *
         random.sign();
}

TEST(IntMajorRaySetup, IsTheRationalAtTiesAndAtTheEndsOfExponentsAndMantissas) {
  Random random(seed + 1);
  int at_two = 0;
  int too_large = 0;
  int at_cap = 0;
  for (int i = 0; i < 14'000 && !HasFailure(); ++i) {
    const MajorBits bits = any_format(random);
    Ray ray;
    ray.direction = direction_at_corners(random, bits);
    ray.origin = vector_of([&] {
      return nudged(at_a_tie(random, bits.finer), random.below(4) == 0 ? random.between(-1, 1) : 0);
    });
    ray.length = adversary::any_length(random);
    expect_rational(ray, Ray::infinite, bits);
    const IntMajorRaySetup set_up(ray, bits);
    for (const MajorQuotient& q : set_up.ray().quotient) {
      at_two += q.mantissa_high == 1U << (bits.mantissa - 1) && q.mantissa_low < q.mantissa_high ? 1 : 0;
      const bool largest = q.mantissa_low == q.mantissa_high && q.mantissa_low == bits.largest_mantissa();
      too_large += largest && q.exponent == bits.largest_exponent() ? 1 : 0;
      at_cap += !largest && q.exponent == bits.largest_exponent() ? 1 : 0;
    }
  }
  EXPECT_GT(at_two, 1'000);
  EXPECT_GT(too_large, 4'000);
  EXPECT_GT(at_cap, 1'000);
}

TEST(IntMajorRaySetup, IsTheRationalForAnyFiniteDirectionAndLength) {
  Random random(seed + 2);
  for (int i = 0; i < 20'000 && !HasFailure(); ++i)
    expect_rational(adversary::any_ray(random), 0, any_format(random));
}

/// Both mirrorings: n = 6, G = 15, and on the grid of g = 0 a half is 7.5. A ray that goes up starts at 7.
/// A ray that goes down starts at 8, and its operand is -8 - 1.
TEST(IntMajorRaySetup, OriginTiesGoAgainstTheDirection) {
  const Ray up{{0.5F, -0.5F, 0.5F}, {1, 1, 0.0F}, 1};
  EXPECT_EQ(IntMajorRaySetup(up, {6, 0, 4}).ray().origin, (Triple{7, -8, 7}));
  const Ray down{{0.5F, -0.5F, 0.5F}, {-1, -1, -0.0F}, 1};
  EXPECT_EQ(IntMajorRaySetup(down, {6, 0, 4}).ray().origin, (Triple{-8 - 1, 7 - 1, 7}));
  // One bit finer, a half is 15 and a quarter is 7.5.
  const Ray finer{{0.5F, 0.25F, 0.25F}, {1, 1, -1}, 1};
  EXPECT_EQ(IntMajorRaySetup(finer, {6, 1, 4}).ray().origin, (Triple{15, 7, -8 - 1}));
}

}  // namespace
}  // namespace hitpipe::ref::int_major_ray_test
