// Float set-up against rational arithmetic: the endpoint is the exact sum, rounded outward along the ray.
#include "sw_ref/quantise/float_ray.hpp"

#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

#include "sw_ref/judge/adversary/categories.hpp"
#include "tests/message_of.hpp"
#include "tests/sw_ref/judge/rational.hpp"

namespace hitpipe::ref::float_ray_test {
namespace {

using adversary::Category;
using adversary::Random;
using adversary::to_text;
using oracle::exact;
using oracle::Rational;

constexpr std::uint64_t seed = 20075;
constexpr float largest = std::numeric_limits<float>::max();
constexpr float smallest = 0x1p-149F;

/// The end is not before the exact end, but the neighbouring binary32 towards the origin is.
void expect_tight(const Ray& ray, float length, int& ends) {
  const FloatEndpoint end = float_endpoint(ray, length);
  bool holds = !std::isinf(length);
  for (int axis = 0; holds && axis < 3; ++axis) {
    const Rational e = exact(ray.origin[axis]) + exact(length) * exact(ray.direction[axis]);
    holds = e <= exact(largest) && e >= exact(-largest);
  }
  ASSERT_EQ(end.infinite, !holds) << to_text(ray);
  if (!holds) {
    EXPECT_EQ(end.at, ray.origin);
    return;
  }
  ++ends;
  for (int axis = 0; axis < 3; ++axis) {
    const float sign = ray.direction[axis] < 0 ? -1.0F : 1.0F;
    const Rational e = (exact(ray.origin[axis]) + exact(length) * exact(ray.direction[axis])) * exact(sign);
    const float at = sign * end.at[axis];
    ASSERT_GE(exact(at), e) << to_text(ray);
    if (at > -largest) {
      ASSERT_LT(exact(std::nextafter(at, -Ray::infinite)), e) << to_text(ray);
    }
  }
}

TEST(FloatEndpoint, IsTheExactOneRoundedOutwardInEveryCategory) {
  std::printf("seed %llu\n", static_cast<unsigned long long>(seed));
  Random random(seed);
  int run = 0;
  int ends = 0;
  for (const Category& category : adversary::categories()) {
    for (int i = 0; i < 2'000; ++i) {
      const Ray ray = category.make(random).ray;
      const float other = std::abs(random.coin() ? random.signed_unit() : random.of_exponent(-149, 127));
      ASSERT_NO_FATAL_FAILURE(expect_tight(ray, ray.length, ends)) << category.name;
      ASSERT_NO_FATAL_FAILURE(expect_tight(ray, other, ends)) << category.name;
      run += 2;
    }
  }
  std::printf("%d of %d rays have a binary32 end\n", ends, run);
  EXPECT_EQ(run, 4'000 * static_cast<int>(adversary::categories().size()));
  EXPECT_GT(ends, run / 2);
}

TEST(FloatEndpoint, FarApartTermsStillRoundOutward) {
  const FloatEndpoint end =
      float_endpoint({{1.0F, 1.0F, -1.0F}, {smallest, -smallest, -smallest}, 1}, smallest);
  EXPECT_FALSE(end.infinite);
  EXPECT_EQ(end.at,
            glm::vec3(std::nextafter(1.0F, 2.0F), std::nextafter(1.0F, 0.0F), std::nextafter(-1.0F, -2.0F)));
}

TEST(FloatEndpoint, ZeroComponentKeepsTheOrigin) {
  const FloatEndpoint end = float_endpoint({{0.1F, 0.2F, 0.3F}, {0.0F, -0.0F, 1.0F}, 1}, largest);
  EXPECT_EQ(end.at.x, 0.1F);
  EXPECT_EQ(end.at.y, 0.2F);
}

TEST(FloatEndpoint, OneThatBinary32CannotHoldIsNoEnd) {
  EXPECT_TRUE(float_endpoint({{0, 0, 0}, {2, 0, 0}, 1}, largest).infinite);
  EXPECT_TRUE(float_endpoint({{0.5F, 0, 0}, {1, 0, 0}, 1}, largest).infinite);
  EXPECT_FALSE(float_endpoint({{0, 0, 0}, {1, 0, 0}, 1}, largest).infinite);
  EXPECT_TRUE(float_endpoint({{0, 0, 0}, {-1, -2, 0}, 1}, largest).infinite);
  EXPECT_TRUE(float_endpoint({{0, 0, 0}, {1, 0, 0}, 1}, Ray::infinite).infinite);
}

TEST(FloatEndpoint, NegativeLengthIsRejected) {
  EXPECT_EQ(message_of<std::invalid_argument>([] {
              (void)float_endpoint({{0, 0, 0}, {1, 0, 0}, 1}, -1.0F);
            }),
            "float_endpoint: length = -1; it must be >= 0 or infinite");
}

TEST(FloatIrdvc, IsTheRoundedInverseWithInfinitiesOfTheZerosSign) {
  const glm::vec3 inverse = float_irdvc({3.0F, 0.0F, -0.0F});
  EXPECT_EQ(std::bit_cast<std::uint32_t>(inverse.x), 0x3EAAAAABU);
  EXPECT_EQ(std::bit_cast<std::uint32_t>(inverse.y), 0x7F800000U);
  EXPECT_EQ(std::bit_cast<std::uint32_t>(inverse.z), 0xFF800000U);
  EXPECT_EQ(float_irdvc({-4.0F, smallest, largest}), glm::vec3(-0.25F, Ray::infinite, 0x1p-128F));
}

}  // namespace
}  // namespace hitpipe::ref::float_ray_test
