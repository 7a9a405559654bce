// The box referee against rational arithmetic, by category of box_cases.hpp.
#include "sw_ref/judge/box_referee.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "sw_ref/judge/binary32.hpp"
#include "tests/sw_ref/judge/box_cases.hpp"
#include "tests/sw_ref/judge/rational.hpp"

namespace hitpipe::ref::box_referee_test {
namespace {

constexpr std::uint64_t seed = 20051;
constexpr int cases_per_category = 12'000;
constexpr float inf = std::numeric_limits<float>::infinity();
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

constexpr Aabb cube{glm::vec3(-0.5F), glm::vec3(0.5F)};

TEST(Binary32, PartsGiveTheValueBack) {
  cases::Random random(seed);
  for (int i = 0; i < 100'000; ++i) {
    const float x = random.any_finite();
    const Binary32 parts = decode(x);
    EXPECT_EQ(std::ldexp(static_cast<double>(parts.mantissa), parts.exponent),
              std::abs(static_cast<double>(x)));
    EXPECT_EQ(parts.negative, std::signbit(x));
    EXPECT_LT(parts.mantissa, 1U << 24);
    EXPECT_TRUE(parts.mantissa >> 23 == 1U || parts.exponent == -149);
  }
}

TEST(BoxReferee, FilterProductsAndIntegersAgreeWithRationals) {
  std::printf("seed %llu\n%9s %9s %9s  category\n", static_cast<unsigned long long>(seed), "cases", "hits",
              "in doubt");
  cases::Random random(seed);
  int total = 0;
  int doubts_of_random = 0;
  int doubts = 0;
  int misses = 0;
  for (const cases::Category& category : cases::categories) {
    int run = 0;
    int hits = 0;
    int in_doubt = 0;
    int refused = 0;
    for (int i = 0; i < cases_per_category; ++i) {
      const cases::Case c = category.make(random);
      if (!acceptable(c.ray) || !acceptable(c.box)) {
        ++refused;
        continue;
      }
      const bool expected = oracle::meets(c.ray, c.box);
      const std::optional<bool> filtered = ray_meets_box_filtered(c.ray, c.box);
      ASSERT_EQ(ray_meets_box_exact(c.ray, c.box), expected) << category.name << ": " << cases::describe(c);
      ASSERT_EQ(ray_meets_box(c.ray, c.box), expected) << category.name << ": " << cases::describe(c);
      ASSERT_EQ(filtered.value_or(expected), expected) << category.name << ": " << cases::describe(c);
      ASSERT_EQ(ray_meets_box_by_products(c.ray, c.box), expected)
          << category.name << ": " << cases::describe(c);
      ++run;
      hits += expected ? 1 : 0;
      in_doubt += filtered ? 0 : 1;
    }
    std::printf("%9d %9d %9d  %s\n", run, hits, in_doubt, category.name);
    EXPECT_EQ(refused, 0) << category.name;
    EXPECT_GT(hits, cases_per_category / 50) << category.name;
    if (category.make == cases::exact_aim) {
      EXPECT_EQ(hits, run);
    }
    misses += run - hits;
    if (&category == &cases::categories.front()) doubts_of_random = in_doubt;
    doubts += in_doubt;
    total += run;
  }
  EXPECT_EQ(total, cases_per_category * static_cast<int>(cases::categories.size()));
  EXPECT_GT(misses, total / 4);
  EXPECT_LT(doubts_of_random, 3);  // the filter must decide nearly all
  EXPECT_GT(doubts, total / 100);  // and the categories must have cases that it cannot decide
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

TEST(BoxReferee, LengthIsInclusive) {
  Ray ray{{-1, 0, 0}, {0.25F, 0, 0}, 2.0F};
  EXPECT_TRUE(ray_meets_box(ray, cube));
  ray.length = std::nextafter(2.0F, 0.0F);
  EXPECT_FALSE(ray_meets_box(ray, cube));
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

TEST(BoxReferee, SteepestRatioIsDecided) {
  const Ray ray{{-1, 0.5F, 0}, {0x1p127F, 0x1p-149F, 0}, inf};
  EXPECT_FALSE(ray_meets_box(ray, cube));  // leaves y = 1/2 upwards long before x = -1/2
  Ray inward = ray;
  inward.direction.y = -0x1p-149F;
  EXPECT_TRUE(ray_meets_box(inward, cube));
}

TEST(Acceptable, RayOutsideTheDomainIsRejected) {
  const Ray good{{1, -1, 0}, {0, 0, 0x1p-149F}, 0.0F};
  EXPECT_TRUE(acceptable(good));
  const auto with = [&](auto change) {
    Ray ray = good;
    change(ray);
    return acceptable(ray);
  };
  EXPECT_TRUE(with([](Ray& r) { r.length = inf; }));
  EXPECT_FALSE(with([](Ray& r) { r.origin.x = std::nextafter(1.0F, 2.0F); }));
  EXPECT_FALSE(with([](Ray& r) { r.origin.y = nan; }));
  EXPECT_FALSE(with([](Ray& r) { r.direction = {0, -0.0F, 0}; }));
  EXPECT_FALSE(with([](Ray& r) { r.direction.x = inf; }));
  EXPECT_FALSE(with([](Ray& r) { r.direction.x = nan; }));
  EXPECT_FALSE(with([](Ray& r) { r.length = -0x1p-149F; }));
  EXPECT_FALSE(with([](Ray& r) { r.length = nan; }));
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
