// The box referee against rational arithmetic, in every category of the adversary.
#include "rays/exact/box_referee.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "rays/exact/binary32.hpp"
#include "sw_ref/judge/adversary/generators.hpp"
#include "tests/rays/exact/rational.hpp"
#include "tests/sw_ref/judge/adversary/each_case.hpp"

namespace hitpipe::ref::box_referee_test {
namespace {

constexpr std::uint64_t seed = 20051;
constexpr float inf = std::numeric_limits<float>::infinity();
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

constexpr Aabb cube{glm::vec3(-0.5F), glm::vec3(0.5F)};

TEST(Binary32, PartsGiveTheValueBack) {
  adversary::Random random(seed);
  for (int i = 0; i < 100'000; ++i) {
    const float x = random.of_exponent(-150, 127);
    const Binary32 parts = decode(x);
    EXPECT_EQ(std::ldexp(static_cast<double>(parts.mantissa), parts.exponent),
              std::abs(static_cast<double>(x)));
    EXPECT_EQ(parts.negative, std::signbit(x));
    EXPECT_LT(parts.mantissa, 1U << 24);
    EXPECT_TRUE(parts.mantissa >> 23 == 1U || parts.exponent == -149);
  }
}

/// A category has both answers, and cases that the filter cannot decide; categories_test.cpp asserts it.
TEST(BoxReferee, FilterProductsAndIntegersAgreeWithRationals) {
  adversary::Random random(seed);
  adversary::each_case(random, 5'000, [](const adversary::Case& c) {
    ASSERT_TRUE(acceptable(c.ray) && acceptable(c.box));
    const bool expected = oracle::meets(c.ray, c.box);
    EXPECT_EQ(ray_meets_box_exact(c.ray, c.box), expected);
    EXPECT_EQ(ray_meets_box(c.ray, c.box), expected);
    EXPECT_EQ(ray_meets_box_filtered(c.ray, c.box).value_or(expected), expected);
    EXPECT_EQ(ray_meets_box_by_products(c.ray, c.box), expected);
  });
}

TEST(BoxReferee, FilterDecidesNearlyAllRandomCases) {
  adversary::Random random(seed + 1);
  int doubts = 0;
  for (int i = 0; i < 12'000; ++i) {
    const adversary::Case c = adversary::random_case(random);
    doubts += ray_meets_box_filtered(c.ray, c.box) ? 0 : 1;
  }
  EXPECT_LT(doubts, 3);
}

TEST(BoxReferee, TouchingCornerIsAHitAndOneUlpBesideAMiss) {
  const Ray at_corner{{0.5F, 0, 0.5F}, {0, 1, 0}, inf};
  EXPECT_TRUE(ray_meets_box(at_corner, cube));
  Ray beside = at_corner;
  beside.origin.x = std::nextafter(0.5F, 1.0F);
  EXPECT_FALSE(ray_meets_box(beside, cube));
  const Ray diagonal{{-1, 0, 0.5F}, {0.5F, 0.5F, 0}, 1.0F};
  EXPECT_TRUE(ray_meets_box(diagonal, cube));  // ends on the edge
}

TEST(BoxReferee, LengthZeroIsThePointOfOrigin) {
  EXPECT_TRUE(ray_meets_box({{0.5F, 0.5F, 0.5F}, {1, 1, 1}, 0.0F}, cube));
  EXPECT_FALSE(ray_meets_box({{0.6F, 0.5F, 0.5F}, {-1, 0, 0}, 0.0F}, cube));
}

TEST(BoxReferee, ZeroIsExactlyZeroAndSubnormalIsNot) {
  const float outside = std::nextafter(0.5F, 1.0F);
  for (const float zero : {0.0F, -0.0F}) {
    EXPECT_FALSE(ray_meets_box({{outside, 0, 0}, {zero, 1, 0}, inf}, cube));
  }
  // 2^-24 to go at 2^-149 per step of t, alone on its axis.
  EXPECT_TRUE(ray_meets_box({{outside, 0, 0}, {-0x1p-149F, 0, 0}, inf}, cube));
  EXPECT_FALSE(ray_meets_box({{outside, 0, 0}, {-0x1p-149F, 0, 0}, 0x1p122F}, cube));
  EXPECT_TRUE(ray_meets_box({{outside, 0, 0}, {-0x1p-149F, 0, 0}, 0x1p125F}, cube));
}

TEST(Acceptable, RayOutsideTheDomainIsRejected) {
  const glm::vec3 along_z{0, 0, 0x1p-149F};
  const float above = std::nextafter(1.0F, 2.0F);
  EXPECT_TRUE(acceptable(Ray{{1, -1, 0}, along_z, 0.0F}));
  EXPECT_TRUE(acceptable(Ray{{1, -1, 0}, along_z, inf}));
  for (const Ray& bad : {Ray{{above, 0, 0}, along_z, 0}, Ray{{0, nan, 0}, along_z, 0},
                         Ray{{}, {0, -0.0F, 0}, 0}, Ray{{}, {inf, 0, 1}, 0}, Ray{{}, {nan, 0, 1}, 0},
                         Ray{{}, along_z, -0x1p-149F}, Ray{{}, along_z, nan}})
    EXPECT_FALSE(acceptable(bad)) << adversary::to_text(bad);
}

TEST(Acceptable, BoxOutsideTheDomainIsRejected) {
  EXPECT_TRUE(acceptable(Aabb{glm::vec3(-1), glm::vec3(1)}));
  EXPECT_TRUE(acceptable(Aabb{glm::vec3(0), glm::vec3(0)}));
  EXPECT_FALSE(acceptable(Aabb{}));
  EXPECT_FALSE(acceptable(Aabb{{0, 0, 0}, {0, -0x1p-149F, 0}}));
  EXPECT_FALSE(acceptable(Aabb{glm::vec3(-1), {1, 1, std::nextafter(1.0F, 2.0F)}}));
  EXPECT_FALSE(acceptable(Aabb{glm::vec3(nan), glm::vec3(1)}));
  EXPECT_FALSE(acceptable(Aabb{glm::vec3(-1), glm::vec3(1, nan, 1)}));
}

}  // namespace
}  // namespace hitpipe::ref::box_referee_test
