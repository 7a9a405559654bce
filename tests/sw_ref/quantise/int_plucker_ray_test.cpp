// Integer Pluecker ray set-up against rational arithmetic, for every n and adversary category.
#include "sw_ref/quantise/int_plucker_ray.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "sw_ref/judge/adversary/categories.hpp"
#include "tests/message_of.hpp"
#include "tests/sw_ref/judge/rational.hpp"

namespace hitpipe::ref::int_plucker_ray_test {
namespace {

using adversary::Category;
using adversary::Random;
using adversary::to_text;
using hls::IntBits;
using oracle::exact;
using oracle::Rational;
using Triple = std::array<std::int32_t, 3>;

constexpr std::uint64_t seed = 20074;
const Rational half = Rational(1) / 2;

std::int64_t grid(int n) {
  return (std::int64_t{1} << (n - 2)) - 1;
}
std::int64_t direction_limit(int n) {
  return (std::int64_t{1} << (n - 1)) - 1;
}

/// M d / max |d|, to nearest, ties away from zero.
oracle::Integer expected_direction(const Ray& ray, int axis, int n) {
  const glm::vec3 d = glm::abs(ray.direction);
  const Rational e = direction_limit(n) * exact(d[axis]) / exact(std::max({d.x, d.y, d.z}));
  const oracle::Integer magnitude = oracle::floor(e + half);
  return ray.direction[axis] < 0 ? oracle::Integer(-magnitude) : magnitude;
}

/// Section 6.3.1 in rational numbers; `rounded` is the direction of the set-up.
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
    const Rational coordinate = minus ? oracle::floor(grid(n) * std::min(o, e))  //
                                      : oracle::ceil(grid(n) * std::max(o, e));
    end.at[i] = static_cast<std::int32_t>(static_cast<std::int64_t>(numerator(coordinate)));
  }
  return end;
}

void expect_exact(const Ray& ray, IntBits bits) {
  const IntPluckerRay result = IntPluckerRaySetup(ray, bits).ray();
  const int n = bits.coord;
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    ASSERT_EQ(result.origin[i], oracle::floor(grid(n) * exact(ray.origin[axis]) + half)) << to_text(ray);
    ASSERT_EQ(result.direction[i], expected_direction(ray, axis, n)) << n << " " << to_text(ray);
    ASSERT_LE(std::abs(std::int64_t{result.end.at[i]}), grid(n)) << n << " " << to_text(ray);
  }
  ASSERT_EQ(result.end, expected_end(ray, ray.length, n, result)) << n << " " << to_text(ray);
}

TEST(IntPluckerRaySetup, IsTheRationalForEveryWidthAndCategory) {
  std::printf("seed %llu\n", static_cast<unsigned long long>(seed));
  Random random(seed);
  int run = 0;
  int ends = 0;
  for (int n = IntBits::min_coord; n <= IntBits::max_coord; ++n) {
    for (const Category& category : adversary::categories()) {
      for (int i = 0; i < 120; ++i) {
        const IntBits bits{n, random.between(IntBits::min_interval, 2 * n - 1)};
        const Ray ray = category.make(random).ray;
        ASSERT_NO_FATAL_FAILURE(expect_exact(ray, bits)) << category.name;
        ends += IntPluckerRaySetup(ray, bits).ray().end.infinite ? 0 : 1;
        ++run;
      }
    }
  }
  std::printf("%d of %d rays end within the cube\n", ends, run);
  EXPECT_EQ(run, 27 * 120 * static_cast<int>(adversary::categories().size()));
  EXPECT_GT(ends, run / 4);
}

TEST(IntPluckerRaySetup, EndpointIsTheRationalForAnyExponents) {
  // Cases in which the terms of the sum lie far apart, cancel, or are both below the last bit of the fixed
  // point.
  Random random(seed + 1);
  int run = 0;
  int ends = 0;
  while (run < 60'000) {
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
    const IntBits bits{random.between(6, 32), 6};
    ASSERT_NO_FATAL_FAILURE(expect_exact(ray, bits));
    ends += IntPluckerRaySetup(ray, bits).ray().end.infinite ? 0 : 1;
    ++run;
  }
  EXPECT_EQ(run, 60'000);
  EXPECT_GT(ends, run / 2);
}

TEST(IntPluckerRaySetup, LargestComponentIsTheLargestInteger) {
  const IntPluckerRay ray = IntPluckerRaySetup({{}, {0x1p-149F, -0x1p-148F, 0x1p-148F}, 1}, {16, 16}).ray();
  EXPECT_EQ(ray.direction, (Triple{16384, -32767, 32767}));  // 16383.5 is a tie
}

TEST(IntPluckerRaySetup, TiesRoundAwayFromZeroSoThatMirroredRaysAreMirrored) {
  // n = 6, M = 31: a component of 1/2 is 15.5, one of 1/62 is 0.5.
  const auto direction = [](glm::vec3 d) { return IntPluckerRaySetup({{}, d, 1}, {6, 6}).ray().direction; };
  EXPECT_EQ(direction({62, 31, 1}), (Triple{31, 16, 1}));
  EXPECT_EQ(direction({-62, -31, -1}), (Triple{-31, -16, -1}));
  EXPECT_EQ(direction({-62, -31, std::nextafter(-1.0F, 0.0F)}), (Triple{-31, -16, 0}));
}

TEST(IntPluckerRaySetup, OriginTiesRoundUpwards) {
  const IntPluckerRay ray = IntPluckerRaySetup({{0.5F, -0.5F, 0.1F}, {1, 1, 1}, 1}, {6, 6}).ray();
  EXPECT_EQ(ray.origin, (Triple{8, -7, 2}));
}

TEST(IntPluckerRaySetup, EndpointIsRoundedOutwardAlongTheRay) {
  // n = 6, G = 15: from 0 to +-0.1, which is +-1.5.
  const IntEndpoint end = IntPluckerRaySetup({{}, {0.1F, -0.1F, 0}, 1}, {6, 6}).ray().end;
  EXPECT_EQ(end.at, (Triple{2, -2, 0}));
  EXPECT_FALSE(end.infinite);
}

TEST(IntPluckerRaySetup, NegativeComponentRoundedToZeroEndsWhereItStarts) {
  // The class is plus, but the ray goes down from 1.5 to 1.0 in x. The end that the unit compares must not be
  // below 1.5.
  const Ray ray{{0.1F, 0, 0}, {-0.0333F, 0, 1}, 1};
  const IntPluckerRay steep = IntPluckerRaySetup(ray, {6, 6}).ray();
  EXPECT_EQ(steep.direction, (Triple{-1, 0, 31}));
  EXPECT_EQ(steep.end.at, (Triple{1, 0, 15}));
  const Ray flat{{0.1F, 0, 0}, {-0.015F, 0, 1}, 1};
  const IntPluckerRay rounded = IntPluckerRaySetup(flat, {6, 6}).ray();
  EXPECT_EQ(rounded.direction, (Triple{0, 0, 31}));
  EXPECT_EQ(rounded.end.at, (Triple{2, 0, 15}));
}

TEST(IntPluckerRaySetup, EndpointOutsideTheCubeIsNoEnd) {
  const auto end = [](float length) {
    return IntPluckerRaySetup({{0.5F, 0, 0}, {0.5F, 0.25F, 0}, length}, {16, 16}).ray().end;
  };
  EXPECT_EQ(end(1.0F), (IntEndpoint{{16383, 4096, 0}, false}));
  EXPECT_EQ(end(std::nextafter(1.0F, 2.0F)), (IntEndpoint{{8192, 0, 0}, true}));
  EXPECT_TRUE(end(0x1p127F).infinite);
  EXPECT_TRUE(end(std::numeric_limits<float>::max()).infinite);
  EXPECT_TRUE(end(Ray::infinite).infinite);
}

TEST(IntPluckerRaySetup, RayOfNoLengthEndsAtItsOriginRoundedOutward) {
  const Ray ray{{0.1F, 0.1F, -0.1F}, {1, -1, 0}, 0};
  EXPECT_EQ(IntPluckerRaySetup(ray, {6, 6}).ray().end, (IntEndpoint{{2, 1, -1}, false}));
}

TEST(IntPluckerRaySetup, ShortenedRayIsThatOfAFreshSetup) {
  Random random(seed + 2);
  int run = 0;
  for (const Category& category : adversary::categories()) {
    for (int i = 0; i < 2'000; ++i) {
      Ray ray = category.make(random).ray;
      const IntBits bits{random.between(6, 32), 6};
      const IntPluckerRaySetup setup(ray, bits);
      ray.length = std::abs(random.coin() ? random.signed_unit() : random.of_exponent(-149, 127));
      ASSERT_EQ(setup.endpoint(ray.length), IntPluckerRaySetup(ray, bits).ray().end) << to_text(ray);
      ++run;
    }
  }
  EXPECT_EQ(run, 2'000 * static_cast<int>(adversary::categories().size()));
}

template <class Error>
std::string message_of(const Ray& ray, IntBits bits = {16, 16}) {
  return hitpipe::message_of<Error>([&] { const IntPluckerRaySetup setup(ray, bits); });
}

TEST(IntPluckerRaySetup, OriginOutsideTheCubeIsRejected) {
  EXPECT_EQ(message_of<std::out_of_range>({{0, std::nextafter(1.0F, 2.0F), 0}, {1, 0, 0}, 1}),
            "IntPluckerRaySetup: origin.y = 1.0000001 is outside the cube; allowed is [-1, 1]");
}

TEST(IntPluckerRaySetup, DirectionWithoutDirectionIsRejected) {
  EXPECT_EQ(message_of<std::invalid_argument>({{}, {0.0F, -0.0F, 0.0F}, 1}),
            "IntPluckerRaySetup: direction is (0, 0, 0); one component must differ from 0");
  EXPECT_EQ(message_of<std::invalid_argument>({{}, {0, 0, -Ray::infinite}, 1}),
            "IntPluckerRaySetup: direction.z = -inf; components must be finite");
}

TEST(IntPluckerRaySetup, NegativeLengthIsRejected) {
  EXPECT_EQ(message_of<std::invalid_argument>({{}, {1, 1, 1}, -0.5F}),
            "IntPluckerRaySetup: length = -0.5; it must be >= 0 or infinite");
}

TEST(IntPluckerRaySetup, FormatOutsideTheRangeIsRejected) {
  EXPECT_EQ(message_of<std::invalid_argument>({{}, {1, 1, 1}, 1}, {33, 24}),
            "IntPluckerRaySetup: format 33/24; n must be 6 to 32 and t 6 to 2n-1");
}

}  // namespace
}  // namespace hitpipe::ref::int_plucker_ray_test
