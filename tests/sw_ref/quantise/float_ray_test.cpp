// Float set-up against rational arithmetic: the endpoint is the exact sum, rounded outward along the ray.
#include "sw_ref/quantise/float_ray.hpp"

#include <bit>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/rays/exact/rational.hpp"
#include "tests/sw_ref/judge/adversary/each_case.hpp"

namespace hitpipe::ref::float_ray_test {
namespace {

using oracle::exact;
using oracle::Rational;

constexpr std::uint64_t seed = 20075;
constexpr float largest = std::numeric_limits<float>::max();
constexpr float smallest = 0x1p-149F;

/// The end is not before the exact end, but the neighbouring binary32 towards the origin is. Returns whether
/// there is an end.
bool expect_tight(const Ray& ray, float length) {
  const FloatEndpoint end = float_endpoint(ray, length);
  const auto exact_end = [&](int axis) {
    return exact(ray.origin[axis]) + exact(length) * exact(ray.direction[axis]);
  };
  bool holds = !std::isinf(length);
  for (int axis = 0; holds && axis < 3; ++axis) holds = abs(exact_end(axis)) <= exact(largest);
  EXPECT_EQ(end.infinite, !holds);
  if (!holds) {
    EXPECT_EQ(end.at, ray.origin);
    return false;
  }
  for (int axis = 0; axis < 3; ++axis) {
    const float sign = ray.direction[axis] < 0 ? -1.0F : 1.0F;
    const Rational e = exact_end(axis) * exact(sign);
    const float at = sign * end.at[axis];
    EXPECT_GE(exact(at), e);
    EXPECT_TRUE(at == -largest || exact(std::nextafter(at, -Ray::infinite)) < e);
  }
  return true;
}

TEST(FloatEndpoint, IsTheExactOneRoundedOutwardInEveryCategory) {
  adversary::Random random(seed);
  int run = 0;
  int ends = 0;
  adversary::each_case(random, 2'000, [&](const adversary::Case& c) {
    run += 2;
    ends += expect_tight(c.ray, c.ray.length) ? 1 : 0;
    ends += expect_tight(c.ray, adversary::any_length(random)) ? 1 : 0;
  });
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

TEST(FloatIrdvc, IsTheRoundedInverseWithInfinitiesOfTheZerosSign) {
  const glm::vec3 inverse = float_irdvc({3.0F, 0.0F, -0.0F});
  EXPECT_EQ(std::bit_cast<std::uint32_t>(inverse.x), 0x3EAAAAABU);
  EXPECT_EQ(std::bit_cast<std::uint32_t>(inverse.y), 0x7F800000U);
  EXPECT_EQ(std::bit_cast<std::uint32_t>(inverse.z), 0xFF800000U);
  EXPECT_EQ(float_irdvc({-4.0F, smallest, largest}), glm::vec3(-0.25F, Ray::infinite, 0x1p-128F));
}

}  // namespace
}  // namespace hitpipe::ref::float_ray_test
