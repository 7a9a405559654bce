// The stiffness measurement: the rays it draws, its counts, and what must follow from one common scale.
#include "sim/check/stiffness.hpp"

#include <cstdio>
#include <set>

#include <gtest/gtest.h>

#include "hls/box/major_format.hpp"
#include "sw_ref/judge/adversary/case.hpp"
#include "tests/sim/small_scene.hpp"

namespace hitpipe::sim::stiffness_test {
namespace {

constexpr std::uint64_t seed = 11;

constexpr std::size_t last = 21;  // the zero component

std::vector<StiffBoxes> measured(const rtl::Design& design, Format format, std::uint64_t tests,
                                 int threads = 2) {
  const auto make = [&] { return make_box_test(design, format); };
  return stiff_boxes(make, {.tests = tests, .seed = seed, .threads = threads});
}

TEST(Stiffnesses, AreEvenPowersAndThenZero) {
  ASSERT_EQ(stiffnesses().size(), last + 1);
  for (std::size_t i = 0; i < last; ++i) EXPECT_EQ(stiffnesses()[i], Stiffness(2 * static_cast<int>(i)));
  EXPECT_EQ(stiffnesses()[last], std::nullopt);
}

TEST(StiffDirection, HasTwoComponentsOfABinadeAndOneSoFarBelow) {
  std::printf("seed %llu, 2200 directions\n", static_cast<unsigned long long>(seed));
  ref::adversary::Random random(seed);
  std::set<int> small_axes;
  for (const Stiffness stiffness : stiffnesses()) {
    for (int i = 0; i < 100; ++i) {
      const glm::vec3 direction = stiff_direction(random, stiffness);
      int large = 0;
      for (int axis = 0; axis < 3; ++axis) {
        const float size = std::abs(direction[axis]);
        const float least = stiffness ? std::ldexp(1.0F, -*stiffness) : 0.0F;
        const bool is_small = size == 0.0F || (size >= least && size < 2 * least);
        const bool is_large = size >= 1.0F && size < 2.0F;
        ASSERT_TRUE(is_small || is_large) << std::hexfloat << size;
        large += is_large ? 1 : 0;
        if (is_small) small_axes.insert(axis);
      }
      ASSERT_EQ(large, stiffness == Stiffness(0) ? 3 : 2);
    }
  }
  EXPECT_EQ(small_axes.size(), 3U);
}

TEST(StiffBoxes, CostTheSlabsMoreTheStifferTheRay) {
  std::printf("seed %llu, %d boxes\n", static_cast<unsigned long long>(seed), 22 * 6000);
  const std::vector<StiffBoxes> all =
      over_all_kinds(measured(rtl::find_design("int_slabs"), hls::IntBits{24, 24}, 6000));
  ASSERT_EQ(all.size(), last + 1);
  for (const StiffBoxes& sum : all) {
    EXPECT_EQ(sum.tests, 6000U);
    EXPECT_EQ(sum.false_misses, 0U);
    EXPECT_GT(sum.hits, 200U);
    EXPECT_LE(sum.false_hits, sum.tests - sum.hits);
  }
  EXPECT_LT(all[0].false_hit_pct(), 0.2);
  EXPECT_LT(all[5].false_hit_pct(), 0.5);    // 2^10: 13 bits are left
  EXPECT_GT(all[15].false_hit_pct(), 10.0);  // 2^30: none
  // Beyond the width no bits are left to lose: two axes tell nothing, as at an exact zero.
  EXPECT_NEAR(all[20].false_hit_pct(), all[last].false_hit_pct(), 5.0);
}

/// Pluecker scales by the largest component: a small one that is rounded to zero costs at most one unit. With
/// a major axis every axis has an exponent of its own, so a small component takes no bits from another.
TEST(StiffBoxes, CostTheOtherDesignsNothing) {
  const std::pair<const char*, Format> units[] = {{"int_plucker", hls::IntBits{24, 24}},
                                                  {"int_major", hls::MajorBits{}}};
  for (const auto& [name, format] : units) {
    for (const StiffBoxes& sum : over_all_kinds(measured(rtl::find_design(name), format, 6000))) {
      EXPECT_EQ(sum.tests, 6000U) << name;
      EXPECT_EQ(sum.false_misses, 0U) << name;
      EXPECT_GT(sum.hits, 200U) << name;
      EXPECT_LT(sum.false_hit_pct(), 0.5) << name;
    }
  }
}

TEST(StiffBoxes, ShareTheTestsAmongTheKinds) {
  const std::vector<StiffBoxes> kinds = measured(rtl::find_design("int_slabs"), hls::IntBits{12, 12}, 601);
  ASSERT_EQ(kinds.size(), 6 * (last + 1));
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    EXPECT_EQ(kinds[i].tests, i % 6 == 0 ? 101U : 100U);
    EXPECT_EQ(kinds[i].stiffness, stiffnesses()[i / 6]);
    EXPECT_EQ(kinds[i].aimed, i % 2 == 0);
    if (kinds[i].aimed) {
      EXPECT_GT(kinds[i].hits, 5U);
    }
  }
}

TEST(StiffBoxes, DoNotDependOnThreads) {
  const rtl::Design& design = rtl::find_design("int_slabs");
  const auto one = measured(design, hls::IntBits{12, 12}, 600, 1);
  const auto more = measured(design, hls::IntBits{12, 12}, 600, 3);
  ASSERT_EQ(one.size(), more.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].hits, more[i].hits);
    EXPECT_EQ(one[i].false_hits, more[i].false_hits);
  }
}

/// A unit that misses everything has all its misses counted.
class MissesAll final : public BoxTest {
 public:
  void start(const ref::Ray& /*ray*/) override {}
  bool hit(const ref::Aabb& /*box*/) override { return false; }
};

TEST(StiffBoxes, CountFalseMisses) {
  for (const StiffBoxes& kind :
       stiff_boxes([] { return std::make_unique<MissesAll>(); }, {.tests = 600, .seed = seed})) {
    EXPECT_EQ(kind.false_misses, kind.hits);
    EXPECT_EQ(kind.false_hits, 0U);
  }
}

TEST(StiffTraversals, FindTheSameTrianglesWithMoreBoxTests) {
  const ref::Scene scene = hills();
  const ref::Bvh bvh = ref::build_bvh(scene.mesh);
  constexpr std::uint64_t rays = 100;
  std::printf("seed %llu, %llu rays\n", static_cast<unsigned long long>(seed),
              static_cast<unsigned long long>(22 * rays));
  const auto sums = stiff_traversals(rtl::find_design("int_slabs"), hls::IntBits{16, 16}, scene.mesh, bvh,
                                     {.rays = rays, .seed = seed, .threads = 2});
  ASSERT_EQ(sums.size(), last + 1);
  for (const StiffTraversals& sum : sums) {
    EXPECT_EQ(sum.rays, rays);
    EXPECT_EQ(sum.different_triangles, 0U);
    EXPECT_GE(sum.box_tests, sum.reference_box_tests);
    EXPECT_GE(sum.reference_box_tests, rays);
  }
  EXPECT_LT(sums[0].extra_box_tests_pct(), 5.0);
  EXPECT_GT(sums[last].extra_box_tests_pct(), 50.0);
}

}  // namespace
}  // namespace hitpipe::sim::stiffness_test
