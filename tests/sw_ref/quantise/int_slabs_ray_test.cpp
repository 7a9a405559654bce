// Integer slabs set-up against rational arithmetic for every n, with examples of zero components.
#include "sw_ref/quantise/int_slabs_ray.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "rays/exact/grid.hpp"
#include "tests/rays/exact/rational.hpp"
#include "tests/sw_ref/judge/adversary/each_case.hpp"

namespace hitpipe::ref::int_slabs_ray_test {
namespace {

using adversary::Random;
using hls::IntBits;
using oracle::exact;
using oracle::Integer;
using oracle::Rational;
using Triple = std::array<std::int32_t, 3>;

constexpr std::uint64_t seed = 20054;

Integer expected_length(float length, const Rational& scale, IntBits bits) {
  const Integer largest = (Integer(1) << static_cast<unsigned>(2 * bits.coord - 2)) - 1;
  const Integer full =
      std::isinf(length) ? largest : oracle::floor(exact(length) * scale * grid_scale(bits.coord));
  return std::min(full, largest) >> static_cast<unsigned>(bits.trimmed());
}

/// `other` is a length to which the set-up is cut.
void expect_rational(const Ray& ray, float other, IntBits bits) {
  SCOPED_TRACE(testing::Message() << bits.coord << "/" << bits.interval << " cut at " << other);
  const IntSlabsRaySetup set_up(ray, bits);
  const IntSlabsRay& result = set_up.ray();
  const std::int64_t most = direction_limit(bits.coord);
  const glm::vec3 size = glm::abs(ray.direction);
  const Rational scale = most * exact(std::min({size.x, size.y, size.z}));
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    const Rational origin = grid_scale(bits.coord) * exact(ray.origin[axis]);
    EXPECT_EQ(result.origin[i], oracle::floor(origin + Rational(1) / 2));
    if (scale != 0) {
      const Rational irdvc = scale / exact(ray.direction[axis]);
      EXPECT_EQ(result.irdvc_floor[i], oracle::floor(irdvc));
      EXPECT_EQ(result.irdvc_ceil[i], oracle::ceil(irdvc));
    }
    EXPECT_LE(std::abs(std::int64_t{result.irdvc_floor[i]}), most);
    EXPECT_LE(std::abs(std::int64_t{result.irdvc_ceil[i]}), most);
  }
  EXPECT_EQ(result.length, expected_length(ray.length, scale, bits));
  EXPECT_EQ(set_up.length(other), expected_length(other, scale, bits));
  EXPECT_EQ(result.infinite, ray.is_infinite());
}

IntBits any_format(Random& random) {
  const int n = random.between(IntBits::min_coord, IntBits::max_coord);
  return {n, random.between(IntBits::min_interval, 2 * n - 1)};
}

TEST(IntSlabsRaySetup, IsTheRationalInEveryCategory) {
  Random random(seed);
  adversary::each_case(random, 1'300, [&](const adversary::Case& c) {
    expect_rational(c.ray, adversary::any_length(random), any_format(random));
  });
}

TEST(IntSlabsRaySetup, IsTheRationalForAnyFiniteDirectionAndLength) {
  Random random(seed + 1);
  for (int i = 0; i < 20'000 && !HasFailure(); ++i)
    expect_rational(adversary::any_ray(random), Ray::infinite, any_format(random));
}

TEST(IntSlabsRaySetup, ZeroIsAnInfinitesimalOfItsSign) {
  const IntSlabsRay one = IntSlabsRaySetup({{}, {0.0F, 1, -2}, Ray::infinite}, {16, 16}).ray();
  EXPECT_EQ(one.irdvc_floor, (Triple{32767, 0, -1}));
  EXPECT_EQ(one.irdvc_ceil, (Triple{32767, 1, 0}));
  const IntSlabsRay two = IntSlabsRaySetup({{}, {-0.0F, 0x1p-149F, 0.0F}, Ray::infinite}, {16, 16}).ray();
  EXPECT_EQ(two.irdvc_floor, (Triple{-32767, 0, 32767}));
  EXPECT_EQ(two.irdvc_ceil, (Triple{-32767, 1, 32767}));
}

}  // namespace
}  // namespace hitpipe::ref::int_slabs_ray_test
