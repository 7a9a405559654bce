// Ray set-up of the units with a major axis against rational arithmetic, for every n and g, with a test for
// each of its corners.
#include "sw_ref/quantise/int_major_ray.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "tests/message_of.hpp"
#include "tests/sw_ref/judge/box_cases.hpp"
#include "tests/sw_ref/judge/rational.hpp"
#include "tests/sw_ref/quantise/major_formats.hpp"

namespace hitpipe::ref::int_major_ray_test {
namespace {

using cases::Random;
using hls::MajorBits;
using oracle::exact;
using oracle::Integer;
using oracle::Rational;
using Axes = std::array<int, 3>;
using Triple = std::array<std::int64_t, 3>;

constexpr std::uint64_t seed = 20081;
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

Rational power_of_two(int exponent) {
  const Rational power = Integer(1) << static_cast<unsigned>(std::abs(exponent));
  return exponent < 0 ? Rational(1) / power : power;
}
std::int64_t grid(int n) {
  return (std::int64_t{1} << (n - 2)) - 1;
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
      exact(length) * exact(std::abs(major)) * grid(bits.coord) * power_of_two(bits.fraction);
  return static_cast<std::int64_t>(std::min(oracle::floor(full), Integer(largest)));
}

void expect_rational(const Ray& ray, MajorBits bits) {
  SCOPED_TRACE(name_of(bits) + ": " + cases::describe(ray));
  const IntMajorRaySetup set_up(ray, bits);
  const IntMajorRay& result = set_up.ray();
  const int major = major_of(ray.direction);
  Axes axes{0, 1, 2};
  std::swap(axes[0], axes[static_cast<std::size_t>(major)]);
  ASSERT_EQ(result.axes, axes);
  const Rational half = Rational(1) / 2;
  for (std::size_t slot = 0; slot < 3; ++slot) {
    const bool backward = ray.direction[axes[slot]] < 0;
    ASSERT_EQ(result.backward[slot], backward);
    // In the mirrored world, where a tie goes down.
    const Rational mirrored =
        (backward ? -1 : 1) * exact(ray.origin[axes[slot]]) * grid(bits.coord) * power_of_two(bits.finer);
    const Integer nearest = oracle::ceil(mirrored - half);
    ASSERT_EQ(result.origin[slot], backward ? nearest - 1 : nearest) << "slot " << slot;
    ASSERT_LE(std::abs(result.origin[slot] + (backward ? 1 : 0)), grid(bits.coord) << bits.finer);
    if (slot == 0) continue;
    ASSERT_EQ(result.quotient[slot - 1],
              expected_quotient(ray.direction[major], ray.direction[axes[slot]], bits))
        << "slot " << slot;
  }
  ASSERT_EQ(set_up.length(ray.length), expected_length(ray.length, ray.direction[major], bits));
}

TEST(IntMajorRaySetup, IsTheRationalForEveryWidthAndCategory) {
  std::printf("seed %llu\n", static_cast<unsigned long long>(seed));
  Random random(seed);
  int run = 0;
  for (int n = MajorBits::min_proved_coord; n <= MajorBits::max_coord; ++n) {
    for (int g = 0; g <= MajorBits::max_finer; ++g) {
      for (const cases::Category& category : cases::categories) {
        for (int i = 0; i < 7; ++i, ++run) {
          ASSERT_NO_FATAL_FAILURE(expect_rational(category.make(random).ray, major_bits(random, n, g)))
              << category.name;
        }
      }
    }
  }
  EXPECT_EQ(run, 29 * 4 * 7 * static_cast<int>(cases::categories.size()));
}

/// Components 2^e apart with mantissas that are alike, or ends of their range: e about the largest exponent,
/// and quotients about 2.
glm::vec3 direction_at_corners(Random& random, MajorBits bits) {
  const auto mantissa = [&] {
    switch (random.below(4)) {
      case 0:
        return 1.0F;
      case 1:
        return cases::nudged(1.0F, random.between(1, 3));
      case 2:
        return cases::nudged(2.0F, -random.between(1, 3));
      default:
        return 2.0F - std::ldexp(1.0F, -random.between(bits.mantissa - 2, bits.mantissa + 1));
    }
  };
  const int cap = bits.coord + bits.finer - 1;
  const auto exponent = [&] { return random.coin() ? cap + random.between(-2, 2) : random.between(0, cap); };
  const std::size_t fast = random.axis();
  const int first = random.between(-100, 120);
  glm::vec3 d{0};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const int less = axis == fast ? 0 : exponent();
    cases::at(d, axis) = random.sign() * std::ldexp(mantissa(), first - less);
    if (axis != fast && random.below(8) == 0) cases::at(d, axis) = random.signed_zero();
    if (axis != fast && random.below(8) == 0) cases::at(d, axis) = random.sign() * cases::at(d, fast);
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
  int run = 0;
  int ties = 0;
  int at_two = 0;
  int too_large = 0;
  int at_cap = 0;
  for (int n = MajorBits::min_proved_coord; n <= MajorBits::max_coord; ++n) {
    for (int g = 0; g <= MajorBits::max_finer; ++g) {
      for (int i = 0; i < 120; ++i, ++run) {
        const MajorBits bits = major_bits(random, n, g);
        Ray ray;
        ray.direction = direction_at_corners(random, bits);
        ray.origin = cases::vector_of([&] {
          ++ties;
          return cases::nudged(at_a_tie(random, g), random.below(4) == 0 ? -random.between(-1, 1) : 0);
        });
        ray.length = std::abs(random.coin() ? random.signed_unit() : random.any_finite());
        ASSERT_NO_FATAL_FAILURE(expect_rational(ray, bits));
        const IntMajorRaySetup set_up(ray, bits);
        for (const MajorQuotient& q : set_up.ray().quotient) {
          at_two += q.mantissa_high == 1U << (bits.mantissa - 1) && q.mantissa_low < q.mantissa_high ? 1 : 0;
          const bool largest = q.mantissa_low == q.mantissa_high && q.mantissa_low == bits.largest_mantissa();
          too_large += largest && q.exponent == bits.largest_exponent() ? 1 : 0;
          at_cap += !largest && q.exponent == bits.largest_exponent() ? 1 : 0;
        }
      }
    }
  }
  std::printf("%d rays: %d upper mantissas of 2, %d quotients too large, %d at the largest exponent\n", run,
              at_two, too_large, at_cap);
  EXPECT_EQ(run, 29 * 4 * 120);
  EXPECT_GT(at_two, 1'000);
  EXPECT_GT(too_large, 4'000);
  EXPECT_GT(at_cap, 1'000);
}

TEST(IntMajorRaySetup, IsTheRationalForAnyFiniteDirectionAndLength) {
  Random random(seed + 2);
  int run = 0;
  for (int i = 0; i < 20'000; ++i, ++run) {
    Ray ray;
    ray.origin = cases::vector_of([&] { return random.signed_unit(); });
    const glm::vec3 direction = cases::vector_of([&] { return random.any_finite(); });
    ray.direction = direction == glm::vec3(0) ? glm::vec3(1) : direction;
    ray.length = std::abs(random.any_finite());
    ASSERT_NO_FATAL_FAILURE(
        expect_rational(ray, major_bits(random, random.between(4, 32), random.between(0, 3))));
  }
  EXPECT_EQ(run, 20'000);
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

TEST(IntMajorRaySetup, OfEqualComponentsTheFirstIsTheMajorAxis) {
  const auto axes = [](const glm::vec3& direction) {
    return IntMajorRaySetup({{}, direction, 1}, {}).ray().axes;
  };
  EXPECT_EQ(axes({1, 1, 1}), (Axes{0, 1, 2}));
  EXPECT_EQ(axes({-1, 1, 1}), (Axes{0, 1, 2}));
  EXPECT_EQ(axes({1, -1, 0.5F}), (Axes{0, 1, 2}));
  EXPECT_EQ(axes({0.5F, 1, -1}), (Axes{1, 0, 2}));
  EXPECT_EQ(axes({-1, 0, 1}), (Axes{0, 1, 2}));
  EXPECT_EQ(axes({1, std::nextafter(1.0F, 2.0F), 1}), (Axes{1, 0, 2}));
  EXPECT_EQ(axes({1, 1, -std::nextafter(1.0F, 2.0F)}), (Axes{2, 1, 0}));
  EXPECT_EQ(axes({-0.0F, 0.0F, 0x1p-149F}), (Axes{2, 1, 0}));
}

TEST(IntMajorRaySetup, EqualComponentsHaveTheQuotientOne) {
  const IntMajorRay ray = IntMajorRaySetup({{}, {-0x1.8p-149F, 0x1.8p-149F, -0x1.8p-149F}, 1}, {}).ray();
  EXPECT_EQ(ray.quotient[0], (MajorQuotient{1U << 12, 1U << 12, 0}));
  EXPECT_EQ(ray.quotient[1], (MajorQuotient{1U << 12, 1U << 12, 0}));
}

TEST(IntMajorRaySetup, ZeroOfEitherSignIsTheLargestQuotientAndNotBackward) {
  const IntMajorRay ray = IntMajorRaySetup({{0.5F, 0.5F, 0.5F}, {0.0F, -0.0F, -2}, 1}, {8, 2, 5}).ray();
  EXPECT_EQ(ray.axes, (Axes{2, 1, 0}));
  EXPECT_EQ(ray.backward, (std::array{true, false, false}));
  EXPECT_EQ(ray.quotient[0], (MajorQuotient{31, 31, 9}));
  EXPECT_EQ(ray.quotient[1], (MajorQuotient{31, 31, 9}));
}

/// n + g = 10, so the largest exponent is 9. p = 5: mantissas 16 .. 31 stand for 1 .. 31/16.
TEST(IntMajorRaySetup, ExponentsEndAtTheirCap) {
  const auto quotient = [](float other) {
    return IntMajorRaySetup({{}, {1, other, 1}, 1}, {8, 2, 5}).ray().quotient[0];
  };
  EXPECT_EQ(quotient(0x1p-8F), (MajorQuotient{16, 16, 8}));
  EXPECT_EQ(quotient(0x1p-9F), (MajorQuotient{16, 16, 9}));
  EXPECT_EQ(quotient(std::nextafter(0x1p-9F, 0.0F)), (MajorQuotient{16, 17, 9}));
  EXPECT_EQ(quotient(std::nextafter(0x1p-9F, 1.0F)), (MajorQuotient{15, 16, 9}));
  EXPECT_EQ(quotient(std::nextafter(0x1p-10F, 1.0F)), (MajorQuotient{31, 31, 9}));
  EXPECT_EQ(quotient(0x1p-10F), (MajorQuotient{31, 31, 9}));
  EXPECT_EQ(quotient(0x1p-149F), (MajorQuotient{31, 31, 9}));
}

TEST(IntMajorRaySetup, UpperMantissaOfTwoTakesTheNextExponent) {
  // (2 - 2^-23) 2^e lies between 31/16 and 2.
  const float below_two = std::nextafter(2.0F, 0.0F);
  const auto quotient = [&](float other) {
    return IntMajorRaySetup({{}, {other, below_two, 0}, 1}, {8, 2, 5}).ray().quotient[0];
  };
  EXPECT_EQ(quotient(1.0F), (MajorQuotient{15, 16, 1}));
  EXPECT_EQ(quotient(0x1p-8F), (MajorQuotient{15, 16, 9}));
  EXPECT_EQ(quotient(0x1p-9F), (MajorQuotient{31, 31, 9}));
  // 31/16 itself fits.
  EXPECT_EQ(IntMajorRaySetup({{}, {1, 31.0F / 16, 0}, 1}, {8, 2, 5}).ray().quotient[0],
            (MajorQuotient{31, 31, 0}));
}

TEST(IntMajorRaySetup, SubnormalComponentsKeepTheirRatio) {
  const IntMajorRay ray = IntMajorRaySetup({{}, {0x1p-149F, -0x3p-149F, 0x1p-148F}, 1}, {16, 1, 8}).ray();
  EXPECT_EQ(ray.axes, (Axes{1, 0, 2}));
  EXPECT_EQ(ray.quotient[0], (MajorQuotient{192, 192, 1}));  // 3
  EXPECT_EQ(ray.quotient[1], (MajorQuotient{192, 192, 0}));  // 3/2
  const IntMajorRay seventh = IntMajorRaySetup({{}, {0x7p-149F, 0x3p-149F, 0}, 1}, {16, 1, 8}).ray();
  EXPECT_EQ(seventh.quotient[0], (MajorQuotient{149, 150, 1}));  // 7/6 * 128 = 149.33
}

TEST(IntMajorRaySetup, LengthsAreRoundedDownAndEndAtTheLargest) {
  const auto length = [](float of_ray, float major, MajorBits bits) {
    return IntMajorRaySetup({{}, {0, major, 0}, 1}, bits).length(of_ray);
  };
  const MajorBits bits{8, 1, 6, 1};  // G = 63, in units of 1/2
  EXPECT_EQ(length(0.0F, 1, bits), 0);
  EXPECT_EQ(length(1.0F, 1, bits), 126);
  EXPECT_EQ(length(std::nextafter(1.0F, 0.0F), -1, bits), 125);
  EXPECT_EQ(length(2.0F, 1, bits), 252);
  EXPECT_EQ(length(2.02F, 1, bits), 254);
  EXPECT_EQ(length(2.03F, 1, bits), 255);  // 255.78
  EXPECT_EQ(length(0x1p127F, 0x1p127F, bits), 255);
  EXPECT_EQ(length(Ray::infinite, 0x1p-149F, bits), 255);
  EXPECT_EQ(length(0x1p-149F, 0x1p-149F, bits), 0);
  EXPECT_EQ(length(0x1p-149F, 0x1p127F, bits), 0);
  EXPECT_EQ(length(0x1p127F, 0x1p-127F, bits), 126);
  // Fewer bits than the unit: floor(63 / 4).
  EXPECT_EQ(length(1.0F, 1, {8, 1, 6, -2}), 15);
  EXPECT_EQ(length(Ray::infinite, 1, {8, 1, 6, -2}), 31);
  // A length that wraps at 64 or 128 bits would come out small.
  for (const float major : {1.0F, 0x1p127F}) {
    for (int e = 2; e <= 127; ++e) {
      EXPECT_EQ(length(std::ldexp(1.0F, e), major, {32, 3, 28, 3}), (std::int64_t{1} << 34) - 1) << e;
      EXPECT_EQ(length(std::ldexp(1.9F, e), major, {32, 3, 28, 3}), (std::int64_t{1} << 34) - 1) << e;
    }
  }
}

TEST(IntMajorRaySetup, ShortenedLengthIsThatOfAFreshSetup) {
  Random random(seed + 3);
  int run = 0;
  for (const cases::Category& category : cases::categories) {
    for (int i = 0; i < 1'000; ++i, ++run) {
      Ray ray = category.make(random).ray;
      const MajorBits bits = major_bits(random, random.between(4, 32), random.between(0, 3));
      const IntMajorRaySetup set_up(ray, bits);
      ray.length = std::abs(random.coin() ? random.signed_unit() : random.any_finite());
      ASSERT_EQ(set_up.length(ray.length), IntMajorRaySetup(ray, bits).length(ray.length))
          << cases::describe(ray);
      ASSERT_EQ(set_up.ray(), IntMajorRaySetup(ray, bits).ray());
    }
  }
  EXPECT_EQ(run, 1'000 * static_cast<int>(cases::categories.size()));
}

template <class Error>
std::string message_of(const Ray& ray, MajorBits bits = {}) {
  return hitpipe::message_of<Error>(
      [&] { static_cast<void>(IntMajorRaySetup(ray, bits).length(ray.length)); });
}

TEST(IntMajorRaySetup, UnacceptableRaysAreRejected) {
  EXPECT_EQ(message_of<std::out_of_range>({{0, std::nextafter(1.0F, 2.0F), 0}, {1, 0, 0}, 1}),
            "IntMajorRaySetup: origin.y = 1.0000001 is outside the cube; allowed is [-1, 1]");
  EXPECT_EQ(message_of<std::invalid_argument>({{}, {0.0F, -0.0F, 0.0F}, 1}),
            "IntMajorRaySetup: direction is (0, 0, 0); one component must differ from 0");
  EXPECT_EQ(message_of<std::invalid_argument>({{}, {0, 0, -Ray::infinite}, 1}),
            "IntMajorRaySetup: direction.z = -inf; components must be finite");
  EXPECT_EQ(message_of<std::invalid_argument>({{}, {1, 1, 1}, -0.5F}),
            "IntMajorRaySetup: length = -0.5; it must be >= 0 or infinite");
  EXPECT_EQ(message_of<std::invalid_argument>({{}, {1, 1, 1}, nan}),
            "IntMajorRaySetup: length = nan; it must be >= 0 or infinite");
  EXPECT_EQ(message_of<std::invalid_argument>({{}, {1, 1, 1}, 1}), "no exception");
}

TEST(IntMajorRaySetup, FormatOutsideTheRangeIsRejected) {
  const auto refusal = [](MajorBits bits) {
    return message_of<std::invalid_argument>({{}, {1, 1, 1}, 1}, bits);
  };
  EXPECT_EQ(refusal({33, 0, 12}), "IntMajorRaySetup: there is no format 33+0/12f0");
  EXPECT_EQ(refusal({3, 0, 12}), "IntMajorRaySetup: there is no format 3+0/12f0");
  EXPECT_EQ(refusal({20, 4, 12}), "IntMajorRaySetup: there is no format 20+4/12f0");
  EXPECT_EQ(refusal({20, -1, 12}), "IntMajorRaySetup: there is no format 20+-1/12f0");
  EXPECT_EQ(refusal({20, 1, 2}), "IntMajorRaySetup: there is no format 20+1/2f0");
  EXPECT_EQ(refusal({20, 1, 33}), "IntMajorRaySetup: there is no format 20+1/33f0");
  EXPECT_EQ(refusal({20, 1, 12, -3}), "IntMajorRaySetup: there is no format 20+1/12f-3");
  EXPECT_EQ(refusal({20, 1, 12, 4}), "IntMajorRaySetup: there is no format 20+1/12f4");
  EXPECT_EQ(refusal({32, 3, 29}), "IntMajorRaySetup: there is no format 32+3/29f0");
  EXPECT_EQ(refusal({4, 0, 3, 3}), "IntMajorRaySetup: there is no format 4+0/3f3");
  EXPECT_EQ(refusal({4, 0, 3, 2}), "no exception");
}

}  // namespace
}  // namespace hitpipe::ref::int_major_ray_test
