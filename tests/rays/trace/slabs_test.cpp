// The box tests against exact rational arithmetic, in every category of the adversary. ConservativeSlabs
// never misses a box that the ray meets. Slabs and Pluecker miss some, which shows that the rays are hard
// enough, but they miss no padded box.
#include "rays/trace/slabs.hpp"

#include <array>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "rays/trace/child_slabs.hpp"
#include "sw_ref/judge/adversary/generators.hpp"
#include "sw_ref/judge/adversary/parts.hpp"
#include "sw_ref/trace/plucker.hpp"
#include "tests/rays/exact/rational.hpp"
#include "tests/sw_ref/judge/adversary/each_case.hpp"

namespace hitpipe::ref::slabs_test {
namespace {

using adversary::Case;
using adversary::Random;

constexpr std::uint64_t seed = 41;

/// Coordinates near zero and a direction that makes the distances subnormal: their products underflow. At
/// about 2^17 subnormal units the other roundings shift a product by part of a unit, and a relative margin is
/// lost in rounding.
Case subnormal_distance(Random& random) {
  Case c = adversary::edge(random);
  const int size = random.between(-119, -90);
  const int distance = -149 + (random.below(4) != 0 ? random.between(16, 19) : random.between(0, 24));
  c.box = {c.box.min * std::ldexp(1.0F, size), c.box.max * std::ldexp(1.0F, size)};
  c.ray.origin *= std::ldexp(1.0F, size);
  c.ray.direction *= std::ldexp(1.0F, size - distance);
  c.ray.length = Ray::infinite;
  return c;
}

using BoxesOfFour = std::array<std::array<float, 4>, 6>;

/// The box in a lane, and others that nothing meets or everything might.
BoxesOfFour among_others(const Aabb& box, std::size_t lane) {
  BoxesOfFour planes{};
  for (unsigned plane = 0; plane < 6; ++plane) planes[plane][lane] = box.plane(plane);
  return planes;
}

/// A box has the same answer in each lane of the test of four children, and no lane misses a box that is met.
void expect_children_as_one(const Case& c, bool met) {
  for (std::size_t lane = 0; lane < 4; ++lane) {
    const BoxesOfFour planes = among_others(c.box, lane);
    float distances[4];
    float distance = 0;
    const bool one = ConservativeSlabs(c.ray).enters(c.box, distance);
    const ChildSlabs<FourLanes, 4, Widening::of_distances> same(c.ray);
    EXPECT_EQ((same.enters(planes, distances) >> lane & 1U) != 0, one);
    EXPECT_EQ(distances[lane], distance);
    const ChildSlabs<FourLanes, 4, Widening::of_inverses> quick(c.ray);
    EXPECT_TRUE((quick.enters(planes, distances) >> lane & 1U) != 0 || !met);
  }
}

/// The tests miss no box that the ray meets: ConservativeSlabs the box itself, the others the box padded as
/// in section 4.3. Counts boxes met, and how many of them Slabs<float> misses without padding.
struct Judge {
  int met = 0, float_misses = 0;

  void operator()(const Case& c) {
    const bool meets = oracle::meets(c.ray, c.box);
    expect_children_as_one(c, meets);
    if (!meets) return;
    ++met;
    EXPECT_TRUE(ConservativeSlabs(c.ray)(c.box));
    constexpr float padding = 5e-7F;
    const Aabb padded{c.box.min - padding, c.box.max + padding};
    EXPECT_TRUE(Slabs<float>(c.ray)(padded));
    EXPECT_TRUE(Slabs<double>(c.ray)(padded));
    EXPECT_TRUE(Plucker<float>(c.ray)(padded));
    EXPECT_TRUE(Plucker<double>(c.ray)(padded));
    float_misses += Slabs<float>(c.ray)(c.box) ? 0 : 1;
  }
};

TEST(BoxTests, ConservativeNeverMissesAndTheOthersMissNoPaddedBox) {
  Random random(seed);
  Judge judge;
  adversary::each_case(random, 2'500, [&](const Case& c) { judge(c); });
  EXPECT_GT(judge.float_misses, 100);
}

TEST(BoxTests, SubnormalDistancesAreNoMisses) {
  Random random(seed + 1);
  Judge judge;
  for (int i = 0; i < 8'000 && !HasFailure(); ++i) {
    const Case c = subnormal_distance(random);
    SCOPED_TRACE(to_text(c));
    judge(c);
  }
  EXPECT_GT(judge.met, 800);
  EXPECT_GT(judge.float_misses, 0);
}

TEST(BoxTests, BoxesAwayFromTheRayAreMissed) {
  Random random(seed);
  int away = 0;
  for (int i = 0; i < 2000; ++i) {
    const Case c = adversary::random_case(random);
    const Aabb larger{c.box.min - 1e-4F, c.box.max + 1e-4F};
    Ray longer = c.ray;
    longer.length *= 1.001F;
    if (oracle::meets(longer, larger)) continue;
    ++away;
    ASSERT_FALSE(ConservativeSlabs(c.ray)(c.box)) << to_text(c);
    ASSERT_FALSE(Slabs<float>(c.ray)(c.box)) << to_text(c);
    ASSERT_FALSE(Slabs<double>(c.ray)(c.box)) << to_text(c);
    ASSERT_FALSE(Plucker<float>(c.ray)(c.box)) << to_text(c);
    ASSERT_FALSE(Plucker<double>(c.ray)(c.box)) << to_text(c);
  }
  EXPECT_GT(away, 1000);
}

TEST(ConservativeSlabs, MissesABoxBesideAParallelRayThatNothingElseBounds) {
  // x is parallel and outside, y is parallel and inside, z is too slow to be a constraint.
  for (const float side : {-0.6F, 0.6F}) {
    const Ray ray{{side, 0.0F, 0.0F}, {0.0F, 0.0F, 1e-40F}};
    EXPECT_FALSE(ConservativeSlabs(ray)(Aabb{{-0.5F, -0.5F, -0.5F}, {0.5F, 0.5F, 0.5F}})) << side;
  }
}

template <class T>
class EveryBoxTest : public testing::Test {};
using All = testing::Types<Slabs<float>, Slabs<double>, ConservativeSlabs, Plucker<float>, Plucker<double>>;
TYPED_TEST_SUITE(EveryBoxTest, All);

constexpr Aabb cube{{-0.5F, -0.5F, -0.5F}, {0.5F, 0.5F, 0.5F}};

/// Tests the ray cut at `length`, with a test that was set up for the whole ray.
template <class Test>
bool meets(const Ray& ray, float length) {
  Test test(ray);
  test.cut(length);
  return test(cube);
}

TYPED_TEST(EveryBoxTest, BoxBehindOrBeyondTheEndIsMissed) {
  const Ray towards{{0, 0, -0.9F}, {0, 0, 1}};
  const Ray away{{0, 0, -0.9F}, {0, 0, -1}};
  EXPECT_TRUE(TypeParam(towards)(cube));
  EXPECT_FALSE(TypeParam(away)(cube));
  EXPECT_TRUE(meets<TypeParam>(towards, 0.41F));
  EXPECT_FALSE(meets<TypeParam>(towards, 0.39F));
}

TYPED_TEST(EveryBoxTest, OriginInsideIsAHitInEveryDirection) {
  for (const float x : {-1.0F, -0.0F, 0.0F, 1.0F})
    for (const float y : {-1.0F, -0.0F, 0.0F, 1.0F})
      for (const float z : {-1.0F, 1.0F}) {
        const Ray ray{{0.1F, -0.2F, 0.3F}, {x, y, z}};
        EXPECT_TRUE(TypeParam(ray)(cube));
        EXPECT_TRUE(meets<TypeParam>(ray, 0.0F));
      }
}

TYPED_TEST(EveryBoxTest, ParallelRayBesideTheBoxIsMissedWhateverTheSignOfZero) {
  for (const float zero : {0.0F, -0.0F})
    for (const float side : {-0.6F, 0.6F}) {
      const Ray ray{{side, 0.0F, -0.9F}, {zero, zero, 1.0F}};
      EXPECT_FALSE(TypeParam(ray)(cube));
      EXPECT_FALSE(meets<TypeParam>(ray, 5.0F));
    }
}

TYPED_TEST(EveryBoxTest, ParallelRayInAFaceIsAHit) {
  for (const float zero : {0.0F, -0.0F})
    for (const float side : {-0.5F, 0.5F}) {
      const Ray ray{{side, side, -0.9F}, {zero, zero, 1.0F}};
      EXPECT_TRUE(TypeParam(ray)(cube));
    }
}

}  // namespace
}  // namespace hitpipe::ref::slabs_test
