// The box tests of chapter 3 against the exact referee. They give the same answers if the box keeps its
// distance from the ray. Otherwise no answer is wrong by more than rounding.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rays/exact/box_referee.hpp"
#include "sw_ref/judge/adversary/categories.hpp"
#include "thesis/timing.hpp"
#include "thesis/variants.hpp"
#include "thesis/workload.hpp"

namespace hitpipe::thesis::box_tests_test {
namespace {

constexpr std::uint64_t seed = 20034;
constexpr std::size_t pairs = 20'000;
constexpr int cases_per_category = 1'000;

std::string describe(const BoxPair& pair) {
  return adversary::to_text(adversary::Case{pair.ray, pair.box});
}

template <class T>
class BoxTests : public testing::Test {};
using Precisions = testing::Types<float, double>;
TYPED_TEST_SUITE(BoxTests, Precisions);

TYPED_TEST(BoxTests, AgreeWithTheRefereeOnWorkloads) {
  for (const int hit_percent : {0, 50, 100}) {
    const std::vector<BoxPair> workload = make_box_workload(pairs, hit_percent, seed);
    std::uint64_t hits = 0;
    for (const BoxPair& pair : workload) {
      const bool exact = ray_meets_box(pair.ray, pair.box);
      hits += exact ? 1 : 0;
      for (const BoxTestVariant& variant : box_test_variants<TypeParam>()) {
        EXPECT_EQ(variant.ask(pair.ray, pair.box).hit, exact) << variant.name << ": " << describe(pair);
      }
    }
    EXPECT_EQ(workload.size(), pairs);
    EXPECT_EQ(hits, pairs * static_cast<std::size_t>(hit_percent) / 100);
    for (const BoxTestVariant& variant : box_test_variants<TypeParam>()) {
      EXPECT_EQ(variant.prepare(workload)->run().hits, hits) << variant.name;
    }
    std::printf("seed %llu: %zu pairs, %llu hits\n", static_cast<unsigned long long>(seed), workload.size(),
                static_cast<unsigned long long>(hits));
  }
}

/// Where the ray enters, in a precision whose errors do not matter.
long double entry_of(const BoxPair& pair) {
  long double entry = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const long double d = pair.ray.direction[axis];
    const float plane = d < 0 ? pair.box.max[axis] : pair.box.min[axis];
    if (d != 0) entry = std::max(entry, (static_cast<long double>(plane) - pair.ray.origin[axis]) / d);
  }
  return entry;
}

/// Difference, inverse and quotient or product are rounded once each: less than four half units in the last
/// place. The plane that is met last may be confused only with one at the same distance within that error.
TYPED_TEST(BoxTests, EntryDistancesErrByAtMostFourRoundings) {
  const std::vector<BoxPair> workload = make_box_workload(pairs, 100, seed + 1);
  const long double bound = 2 * static_cast<long double>(std::numeric_limits<TypeParam>::epsilon());
  int with_distance = 0;
  for (const BoxTestVariant& variant : box_test_variants<TypeParam>()) {
    with_distance += variant.has_distance ? 1 : 0;
    double worst = 0;
    int not_zero = 0;
    for (const BoxPair& pair : workload) {
      const long double exact = entry_of(pair);
      const auto entry = static_cast<long double>(variant.ask(pair.ray, pair.box).entry);
      if (!variant.has_distance) {
        EXPECT_EQ(entry, 0) << variant.name;
        continue;
      }
      ASSERT_LE(std::abs(entry - exact), bound * exact) << variant.name << ": " << describe(pair);
      if (exact == 0) continue;
      ++not_zero;
      worst = std::max(worst, static_cast<double>(std::abs(entry - exact) / exact));
    }
    if (variant.has_distance) {
      EXPECT_GT(not_zero, static_cast<int>(pairs / 2)) << variant.name;
      std::printf("%-16s %zu pairs, worst relative error %.2f of 4 roundings\n",
                  std::string(variant.name).c_str(), workload.size(), 4 * worst / static_cast<double>(bound));
    }
  }
  EXPECT_EQ(with_distance, 9);
}

/// The box with every face moved outward; empty if it is too thin for a move inward.
bool meets_moved(const BoxPair& pair, double outward) {
  Aabb moved;
  for (int axis = 0; axis < 3; ++axis) {
    moved.min[axis] = static_cast<float>(pair.box.min[axis] - outward);
    moved.max[axis] = static_cast<float>(pair.box.max[axis] + outward);
    if (moved.min[axis] > moved.max[axis]) return false;
  }
  return ray_meets_box(pair.ray, moved);
}

/// Slabs distances err by three roundings of coordinates up to 2 and side relations by six of products up to
/// 2 times a component: no more than if a plane were moved by eight roundings of 2. In binary64 that is below
/// what a binary32 box can show, so its boxes are moved by one rounding of binary32.
template <class T>
constexpr double rounding_distance = sizeof(T) == sizeof(float) ? 0x1p-20 : 0x1p-23;

/// The ray with its largest direction component in [1/2, 1): side relations of directions far from unit
/// length underflow.
Ray of_unit_size(Ray ray) {
  const glm::vec3 size = glm::abs(ray.direction);
  int exponent = 0;
  (void)std::frexp(std::max({size.x, size.y, size.z}), &exponent);
  for (int axis = 0; axis < 3; ++axis) ray.direction[axis] = std::ldexp(ray.direction[axis], -exponent);
  ray.length = Ray::infinite;
  return ray;
}

/// Two entry planes are met within rounding of each other. Woo's test computes the point on the one that
/// seems the later and may find it outside the other, though the ray goes on into the box.
bool enters_at_edge(const BoxPair& pair, double tolerance) {
  std::vector<double> met;
  for (int axis = 0; axis < 3; ++axis) {
    const double d = pair.ray.direction[axis];
    const double plane = std::signbit(d) ? pair.box.max[axis] : pair.box.min[axis];
    if (d != 0) met.push_back((plane - pair.ray.origin[axis]) / d);
  }
  std::sort(met.rbegin(), met.rend());
  return met.size() > 1 && met[0] - met[1] <= tolerance * met[0];
}

TYPED_TEST(BoxTests, ErrByNoMoreThanRoundingWhereRaysGraze) {
  adversary::Random random(seed + 2);
  const auto variants = box_test_variants<TypeParam>();
  std::vector<int> wrong(variants.size());
  int cases = 0;
  int grazing = 0;
  for (const adversary::Category& category : adversary::categories()) {
    for (int i = 0; i < cases_per_category; ++i) {
      const adversary::Case c = category.make(random);
      const BoxPair pair{of_unit_size(c.ray), c.box};
      const bool exact = ray_meets_box(pair.ray, pair.box);
      const bool doubtful =
          meets_moved(pair, rounding_distance<TypeParam>) != meets_moved(pair, -rounding_distance<TypeParam>);
      ++cases;
      grazing += doubtful ? 1 : 0;
      for (std::size_t v = 0; v < variants.size(); ++v) {
        if (variants[v].ask(pair.ray, pair.box).hit == exact) continue;
        ++wrong[v];
        if (exact && variants[v].name == "woo" && enters_at_edge(pair, rounding_distance<TypeParam>))
          continue;
        EXPECT_TRUE(doubtful) << category.name << ", " << variants[v].name << (exact ? " misses " : " hits ")
                              << describe(pair);
      }
    }
  }
  std::printf("seed %llu: %d cases, %d grazing; wrong there:", static_cast<unsigned long long>(seed + 2),
              cases, grazing);
  for (std::size_t v = 0; v < variants.size(); ++v) {
    std::printf(" %s %d", std::string(variants[v].name).c_str(), wrong[v]);
  }
  std::printf("\n");
  EXPECT_EQ(cases, 27 * cases_per_category);
  EXPECT_GT(grazing, cases / 4);
  EXPECT_LT(grazing, cases * 3 / 4);
}

TYPED_TEST(BoxTests, AreNamedInTheOrderOfTables3_1And3_2) {
  std::vector<std::string> names;
  for (const BoxTestVariant& variant : box_test_variants<TypeParam>()) names.emplace_back(variant.name);
  EXPECT_THAT(names, testing::ElementsAre("plu", "plu-int-div", "plu-int-mul", "plu-cff", "plu-cff-int-div",
                                          "plu-cff-int-mul", "slabs-div", "slabs-mul", "slabs8-div",
                                          "slabs8-mul", "sat", "woo"));
}

TEST(BoxWorkload, SameSeedGivesTheSamePairsAndMixesThem) {
  const std::vector<BoxPair> one = make_box_workload(1'000, 50, seed);
  const std::vector<BoxPair> other = make_box_workload(1'000, 50, seed);
  int hits_of_first_half = 0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(describe(one[i]), describe(other[i]));
    if (i < 500 && ray_meets_box(one[i].ray, one[i].box)) ++hits_of_first_half;
  }
  EXPECT_GT(hits_of_first_half, 200);
  EXPECT_LT(hits_of_first_half, 300);
}

TEST(BoxWorkload, ShareBeyondAllIsRejected) {
  try {
    (void)make_box_workload(10, 101, seed);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "box workload: 101 % hits; allowed are 0 to 100");
  }
}

TEST(BoxTiming, TimesEveryVariantMixAndPrecision) {
  const std::vector<BoxTestTiming> timings = time_box_tests(200, 3, seed);
  ASSERT_EQ(timings.size(), 12U * 3U * 2U);
  EXPECT_EQ(timings.front().variant, "plu");
  EXPECT_EQ(timings.front().precision_bits, 32);
  EXPECT_EQ(timings[12].hit_percent, 50);
  EXPECT_EQ(timings.back().variant, "woo");
  EXPECT_EQ(timings.back().precision_bits, 64);
  EXPECT_EQ(timings.back().hit_percent, 100);
  for (const BoxTestTiming& timing : timings) {
    EXPECT_EQ(timing.tests, 600U);
    EXPECT_GE(timing.seconds, 0);
  }
}

}  // namespace
}  // namespace hitpipe::thesis::box_tests_test
