// Integer ray set-up against rational arithmetic for every n, with a test for each trap of a careless set-up.
#include "sw_ref/quantise/int_slabs_ray.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "tests/message_of.hpp"
#include "tests/sw_ref/judge/box_cases.hpp"
#include "tests/sw_ref/judge/rational.hpp"

namespace hitpipe::ref::int_slabs_ray_test {
namespace {

using cases::Random;
using hls::IntBits;
using oracle::exact;
using oracle::Integer;
using oracle::Rational;
using Triple = std::array<std::int32_t, 3>;

constexpr std::uint64_t seed = 20054;
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

std::int64_t grid(int n) {
  return (std::int64_t{1} << (n - 2)) - 1;
}
std::int64_t irdvc_max(int n) {
  return (std::int64_t{1} << (n - 1)) - 1;
}

Rational scale_of(const Ray& ray, int n) {
  return irdvc_max(n) *
         exact(std::min({std::abs(ray.direction.x), std::abs(ray.direction.y), std::abs(ray.direction.z)}));
}

Integer expected_length(const Ray& ray, IntBits bits) {
  const Integer largest = (Integer(1) << static_cast<unsigned>(2 * bits.coord - 2)) - 1;
  Integer full = largest;
  if (!ray.is_infinite()) {
    full = oracle::floor(exact(ray.length) * scale_of(ray, bits.coord) * grid(bits.coord));
  }
  return std::min(full, largest) >> static_cast<unsigned>(bits.trimmed());
}

void expect_bounds(const Ray& ray, IntBits bits) {
  const IntSlabsRay result = IntSlabsRaySetup(ray, bits).ray();
  const Rational scale = scale_of(ray, bits.coord);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Rational direction = exact(cases::at(ray.direction, axis));
    const Rational origin = grid(bits.coord) * exact(cases::at(ray.origin, axis));
    ASSERT_EQ(result.origin[axis], oracle::floor(origin + Rational(1) / 2)) << cases::describe(ray);
    if (scale != 0) {
      ASSERT_EQ(result.irdvc_floor[axis], oracle::floor(scale / direction)) << cases::describe(ray);
      ASSERT_EQ(result.irdvc_ceil[axis], oracle::ceil(scale / direction)) << cases::describe(ray);
    }
    ASSERT_LE(std::abs(std::int64_t{result.irdvc_floor[axis]}), irdvc_max(bits.coord));
    ASSERT_LE(std::abs(std::int64_t{result.irdvc_ceil[axis]}), irdvc_max(bits.coord));
  }
  ASSERT_EQ(result.length, expected_length(ray, bits)) << cases::describe(ray) << " n = " << bits.coord;
  ASSERT_EQ(result.infinite, ray.is_infinite());
}

TEST(IntSlabsRaySetup, IsTheRationalForEveryWidthAndCategory) {
  std::printf("seed %llu\n", static_cast<unsigned long long>(seed));
  Random random(seed);
  int run = 0;
  for (int n = IntBits::min_coord; n <= IntBits::max_coord; ++n) {
    for (const cases::Category& category : cases::categories) {
      for (int i = 0; i < 120; ++i) {
        const IntBits bits{n, random.between(IntBits::min_interval, 2 * n - 1)};
        ASSERT_NO_FATAL_FAILURE(expect_bounds(category.make(random).ray, bits)) << category.name;
        ++run;
      }
    }
  }
  EXPECT_EQ(run, 27 * 120 * static_cast<int>(cases::categories.size()));
}

TEST(IntSlabsRaySetup, IsTheRationalForAnyFiniteDirectionAndLength) {
  Random random(seed + 1);
  int run = 0;
  for (int i = 0; i < 20'000; ++i) {
    Ray ray;
    ray.origin = cases::vector_of([&] { return random.signed_unit(); });
    const glm::vec3 direction = cases::vector_of([&] { return random.any_finite(); });
    ray.direction = direction == glm::vec3(0) ? glm::vec3(1) : direction;
    ray.length = std::abs(random.any_finite());
    const int n = random.between(6, 32);
    ASSERT_NO_FATAL_FAILURE(expect_bounds(ray, {n, random.between(6, 2 * n - 1)}));
    ++run;
  }
  EXPECT_EQ(run, 20'000);
}

TEST(IntSlabsRaySetup, OriginTiesRoundUpwards) {
  // n = 6, G = 15: +-0.5 is +-7.5, 0.1 rounds down.
  const IntSlabsRay ray = IntSlabsRaySetup({{0.5F, -0.5F, 0.1F}, {1, 1, 1}, 1}, {6, 6}).ray();
  EXPECT_EQ(ray.origin, (Triple{8, -7, 2}));
}

TEST(IntSlabsRaySetup, SmallestComponentGivesTheLargestIrdvcExactly) {
  Random random(seed + 2);
  for (int i = 0; i < 20'000; ++i) {
    const cases::Case c = cases::random_case(random);
    const glm::vec3& d = c.ray.direction;
    const int n = random.between(6, 32);
    const IntSlabsRay ray = IntSlabsRaySetup(c.ray, {n, 6}).ray();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (std::abs(cases::at(d, axis)) > std::min({std::abs(d.x), std::abs(d.y), std::abs(d.z)})) continue;
      const std::int64_t expected = cases::at(d, axis) < 0 ? -irdvc_max(n) : irdvc_max(n);
      ASSERT_EQ(ray.irdvc_floor[axis], expected);
      ASSERT_EQ(ray.irdvc_ceil[axis], expected);
    }
  }
}

TEST(IntSlabsRaySetup, SubnormalComponentsKeepTheirRatio) {
  const IntSlabsRay ray = IntSlabsRaySetup({{}, {0x1p-149F, -0x1p-148F, 0x3p-149F}, 1}, {16, 16}).ray();
  EXPECT_EQ(ray.irdvc_floor, (Triple{32767, -16384, 10922}));
  EXPECT_EQ(ray.irdvc_ceil, (Triple{32767, -16383, 10923}));
}

TEST(IntSlabsRaySetup, ZeroIsAnInfinitesimalOfItsSign) {
  const IntSlabsRay one = IntSlabsRaySetup({{}, {0.0F, 1, -2}, Ray::infinite}, {16, 16}).ray();
  EXPECT_EQ(one.irdvc_floor, (Triple{32767, 0, -1}));
  EXPECT_EQ(one.irdvc_ceil, (Triple{32767, 1, 0}));
  const IntSlabsRay two = IntSlabsRaySetup({{}, {-0.0F, 0x1p-149F, 0.0F}, Ray::infinite}, {16, 16}).ray();
  EXPECT_EQ(two.irdvc_floor, (Triple{-32767, 0, 32767}));
  EXPECT_EQ(two.irdvc_ceil, (Triple{-32767, 1, 32767}));
}

TEST(IntSlabsRaySetup, ZeroComponentMakesAFiniteLengthZero) {
  const IntSlabsRaySetup setup({{}, {0.0F, 1, 1}, 0x1p127F}, {16, 31});
  EXPECT_EQ(setup.ray().length, 0);
  EXPECT_FALSE(setup.ray().infinite);
  EXPECT_EQ(setup.length(Ray::infinite), (1 << 30) - 1);
}

TEST(IntSlabsRaySetup, FloorOfATinyNegativeIsMinusOneAndCeilOfATinyPositiveIsOne) {
  // Ratio 2^-60: floor(-0.0) and ceil(+0.0) of the C library would give 0 once the quotient underflows.
  const IntSlabsRay ray = IntSlabsRaySetup({{}, {0x1p-60F, 1, -1}, 1}, {32, 32}).ray();
  EXPECT_EQ(ray.irdvc_floor, (Triple{0x7FFFFFFF, 0, -1}));
  EXPECT_EQ(ray.irdvc_ceil, (Triple{0x7FFFFFFF, 1, 0}));
  EXPECT_EQ(std::floor(-0.0), 0.0);
  EXPECT_EQ(std::ceil(+0.0), 0.0);
}

TEST(IntSlabsRaySetup, LongOrStiffRaySaturatesInsteadOfOverflowing) {
  const std::int64_t largest = (std::int64_t{1} << 30) - 1;
  EXPECT_EQ(IntSlabsRaySetup({{}, {1, 1, 1}, 3.0F}, {16, 31}).ray().length, largest);
  EXPECT_EQ(IntSlabsRaySetup({{}, {0x1p127F, 0x1p127F, 0x1p127F}, 0x1p127F}, {16, 31}).ray().length, largest);
  EXPECT_EQ(IntSlabsRaySetup({{}, {1, 1, 1}, 1.0F}, {16, 31}).ray().length, 32767 * 16383);
  EXPECT_EQ(IntSlabsRaySetup({{}, {1, 1, 1}, 1.0F}, {16, 16}).ray().length, (32767 * 16383) >> 15);
  EXPECT_EQ(IntSlabsRaySetup({{}, {1, 1, 0x1p-149F}, 0x1p127F}, {16, 31}).ray().length,
            (32767 * 16383) >> 22);
  EXPECT_EQ(IntSlabsRaySetup({{}, {1, 1, 0x1p-149F}, 0x1p-149F}, {16, 31}).ray().length, 0);
}

TEST(IntSlabsRaySetup, InfiniteRayHasTheLargestTrimmedLength) {
  const IntSlabsRay ray = IntSlabsRaySetup({{}, {1, 1, 1}, Ray::infinite}, {32, 63}).ray();
  EXPECT_TRUE(ray.infinite);
  EXPECT_EQ(ray.length, (std::int64_t{1} << 62) - 1);
  EXPECT_EQ(IntSlabsRaySetup({{}, {1, 1, 1}, Ray::infinite}, {20, 24}).ray().length, (1 << 23) - 1);
}

TEST(IntSlabsRaySetup, ShortenedLengthIsThatOfAFreshSetup) {
  Random random(seed + 3);
  int run = 0;
  for (const cases::Category& category : cases::categories) {
    for (int i = 0; i < 2'000; ++i) {
      Ray ray = category.make(random).ray;
      const int n = random.between(6, 32);
      const IntBits bits{n, random.between(6, 2 * n - 1)};
      const IntSlabsRaySetup setup(ray, bits);
      ray.length = std::abs(random.coin() ? random.signed_unit() : random.any_finite());
      ASSERT_EQ(setup.length(ray.length), IntSlabsRaySetup(ray, bits).ray().length) << cases::describe(ray);
      ++run;
    }
  }
  EXPECT_EQ(run, 2'000 * static_cast<int>(cases::categories.size()));
}

// The results of plain binary32 code, which show that the exact set-up is needed.

struct Bounds {
  std::array<std::int64_t, 3> low;
  std::array<std::int64_t, 3> high;
};

Bounds binary32_setup(const glm::vec3& direction, int n) {
  const float scale = static_cast<float>(irdvc_max(n)) *
                      std::min({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)});
  Bounds bounds{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float irdvc = scale / cases::at(direction, axis);
    bounds.low[axis] = static_cast<std::int64_t>(std::floor(irdvc));
    bounds.high[axis] = static_cast<std::int64_t>(std::ceil(irdvc));
  }
  return bounds;
}

/// Whether some scale s > 0 has low <= s / r <= high on every axis: low * r and high * r are exact in double
/// for n <= 24.
bool bound_some_scale(const Bounds& bounds, const glm::vec3& direction) {
  double from = 0;
  double to = std::numeric_limits<double>::infinity();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double r = cases::at(direction, axis);
    const double p = static_cast<double>(bounds.low[axis]) * r;
    const double q = static_cast<double>(bounds.high[axis]) * r;
    from = std::max(from, std::min(p, q));
    to = std::min(to, std::max(p, q));
  }
  return from <= to && to > 0;
}

TEST(IntSlabsRaySetup, Binary32SetupIsNoBoundWhereOursIs) {
  constexpr int count = 100'000;
  struct Row {
    int n;
    int at_least;  // of `count`: half of the first measurements, 0.15 %, 2.4 %, 35 %
  };
  for (const Row& row : {Row{16, 75}, Row{20, 1'200}, Row{24, 17'500}}) {
    Random random(seed + 4);
    int loose = 0;
    for (int i = 0; i < count; ++i) {
      Ray ray;
      ray.direction = cases::vector_of([&] { return random.signed_unit(); });
      loose += bound_some_scale(binary32_setup(ray.direction, row.n), ray.direction) ? 0 : 1;
      const IntSlabsRay ours = IntSlabsRaySetup(ray, {row.n, row.n}).ray();
      Bounds bounds{};
      std::copy(ours.irdvc_floor.begin(), ours.irdvc_floor.end(), bounds.low.begin());
      std::copy(ours.irdvc_ceil.begin(), ours.irdvc_ceil.end(), bounds.high.begin());
      ASSERT_TRUE(bound_some_scale(bounds, ray.direction)) << cases::describe(ray);
    }
    std::printf("n = %d: binary32 set-up bounds no single scale for %.2f %% of %d rays\n", row.n,
                100.0 * loose / count, count);
    EXPECT_GE(loose, row.at_least) << row.n;
  }
}

TEST(IntSlabsRaySetup, Binary32CeilingRunsPastTheWidthWhereOursDoesNot) {
  constexpr int count = 100'000;
  for (const int n : {16, 20, 24}) {
    Random random(seed + 5);
    int past = 0;
    for (int i = 0; i < count; ++i) {
      Ray ray;
      ray.direction = cases::vector_of([&] { return random.signed_unit(); });
      const Bounds naive = binary32_setup(ray.direction, n);
      const IntSlabsRay ours = IntSlabsRaySetup(ray, {n, n}).ray();
      bool beyond = false;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        beyond = beyond || naive.high[axis] > irdvc_max(n) || naive.low[axis] < -irdvc_max(n);
        ASSERT_LE(ours.irdvc_ceil[axis], irdvc_max(n));
        ASSERT_GE(ours.irdvc_floor[axis], -irdvc_max(n));
      }
      past += beyond ? 1 : 0;
    }
    std::printf("n = %d: binary32 IRDVC past +-(2^(n-1)-1) for %.2f %% of %d rays\n", n, 100.0 * past / count,
                count);
    EXPECT_GT(past, count / 20) << n;
  }
}

template <class Error>
std::string message_of(const Ray& ray, IntBits bits = {16, 16}) {
  return hitpipe::message_of<Error>([&] { const IntSlabsRaySetup setup(ray, bits); });
}

TEST(IntSlabsRaySetup, OriginOutsideTheCubeIsRejected) {
  EXPECT_EQ(message_of<std::out_of_range>({{0, std::nextafter(1.0F, 2.0F), 0}, {1, 0, 0}, 1}),
            "IntSlabsRaySetup: origin.y = 1.0000001 is outside the cube; allowed is [-1, 1]");
  EXPECT_EQ(message_of<std::out_of_range>({{0, 0, nan}, {1, 0, 0}, 1}),
            "IntSlabsRaySetup: origin.z = nan is outside the cube; allowed is [-1, 1]");
}

TEST(IntSlabsRaySetup, DirectionWithoutDirectionIsRejected) {
  EXPECT_EQ(message_of<std::invalid_argument>({{}, {0.0F, -0.0F, 0.0F}, 1}),
            "IntSlabsRaySetup: direction is (0, 0, 0); one component must differ from 0");
  EXPECT_EQ(message_of<std::invalid_argument>({{}, {0, 0, -Ray::infinite}, 1}),
            "IntSlabsRaySetup: direction.z = -inf; components must be finite");
}

TEST(IntSlabsRaySetup, NegativeLengthIsRejected) {
  EXPECT_EQ(message_of<std::invalid_argument>({{}, {1, 1, 1}, -0.5F}),
            "IntSlabsRaySetup: length = -0.5; it must be >= 0 or infinite");
  EXPECT_EQ(message_of<std::invalid_argument>({{}, {1, 1, 1}, nan}),
            "IntSlabsRaySetup: length = nan; it must be >= 0 or infinite");
}

TEST(IntSlabsRaySetup, FormatOutsideTheRangeIsRejected) {
  EXPECT_EQ(message_of<std::invalid_argument>({{}, {1, 1, 1}, 1}, {33, 24}),
            "IntSlabsRaySetup: format 33/24; n must be 6 to 32 and t 6 to 2n-1");
  EXPECT_EQ(message_of<std::invalid_argument>({{}, {1, 1, 1}, 1}, {6, 12}),
            "IntSlabsRaySetup: format 6/12; n must be 6 to 32 and t 6 to 2n-1");
}

}  // namespace
}  // namespace hitpipe::ref::int_slabs_ray_test
