// The C++ of the integer units never misses a box that the exact referee hits, in every category and format,
// with finite and infinite rays, also on coarser axes.
#include <array>
#include <cstdint>
#include <cstdio>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "sw_ref/judge/adversary/categories.hpp"
#include "sw_ref/judge/box_referee.hpp"
#include "sw_ref/quantise/coarse_axes.hpp"
#include "sw_ref/quantise/int_box.hpp"
#include "sw_ref/quantise/int_plucker_ray.hpp"
#include "sw_ref/quantise/int_slabs_ray.hpp"
#include "tests/sw_ref/judge/adversary/halved.hpp"
#include "tests/sw_ref/quantise/native_units.hpp"

namespace hitpipe::ref::false_miss_test {
namespace {

using adversary::Case;
using adversary::Category;
using adversary::to_text;
using hls::IntFormat;

constexpr std::uint64_t seed = 20072;

struct Unit {
  hls::IntBits bits;
  bool (*hit)(const Ray&, const IntBox&, const CoarseAxes&);
  int most_false_hits_pct;  ///< limit for random cases; a unit that always hits would never miss
  CoarseAxes coarse{};
};

template <template <class> class Design>
constexpr std::array<Unit, 10> units_of{{{{24, 24}, Design<IntFormat<24, 24>>::hit, 1},
                                         {{20, 24}, Design<IntFormat<20, 24>>::hit, 1},
                                         {{16, 16}, Design<IntFormat<16, 16>>::hit, 1},
                                         {{12, 12}, Design<IntFormat<12, 12>>::hit, 1},
                                         {{8, 8}, Design<IntFormat<8, 8>>::hit, 15},
                                         {{6, 6}, Design<IntFormat<6, 6>>::hit, 50},
                                         {{6, 11}, Design<IntFormat<6, 11>>::hit, 50},
                                         {{20, 20}, Design<IntFormat<20, 20>>::hit, 1},
                                         {{24, 32}, Design<IntFormat<24, 32>>::hit, 1},
                                         {{32, 63}, Design<IntFormat<32, 63>>::hit, 1}}};

template <template <class> class Design>
constexpr std::array<Unit, 5> coarse_units_of{{{{24, 24}, Design<IntFormat<24, 24>>::hit, 1, {{0, 0, 5}}},
                                               {{16, 16}, Design<IntFormat<16, 16>>::hit, 1, {{1, 2, 3}}},
                                               {{12, 12}, Design<IntFormat<12, 12>>::hit, 1, {{4, 0, 1}}},
                                               {{6, 6}, Design<IntFormat<6, 6>>::hit, 40, {{0, 2, 1}}},
                                               {{6, 11}, Design<IntFormat<6, 11>>::hit, 40, {{3, 0, 0}}}}};

struct Judged {
  int cases = 0;
  int as_they_come = 0;  ///< the others are drawn towards the middle, where the coarser grid has room
  int hits = 0;
  int false_hits = 0;
  int false_misses = 0;
};

/// |difference of a box coordinate and the origin| <= 2^(n-1) - 1, or it wraps in n bits.
bool differences_fit(const IntBox& box, const IntOrigin& origin, int coord_bits) {
  const std::int64_t largest = (std::int64_t{1} << (coord_bits - 1)) - 1;
  for (std::size_t i = 0; i < 3; ++i) {
    for (const std::int64_t plane : {box.min[i], box.max[i]}) {
      if (std::abs(plane - origin[i]) > largest) return false;
    }
  }
  return true;
}

bool fits(const Case& c, const Unit& unit) {
  const IntOrigin origin = IntSlabsRaySetup(c.ray, unit.bits).ray().origin;
  return fits_grid(origin, quantise_box(c.box, unit.bits.coord), unit.coarse, unit.bits.coord);
}

Judged judge(const Unit& unit, const std::vector<Case>& cases, const std::vector<bool>& expected) {
  Judged judged;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const bool as_it_comes = fits(cases[i], unit);
    const Case c = as_it_comes ? cases[i] : adversary::halved(cases[i]);
    const bool meets = as_it_comes ? expected[i] : ray_meets_box(c.ray, c.box);
    const IntBox box = coarse_box(quantise_box(c.box, unit.bits.coord), unit.coarse, unit.bits.coord);
    const IntOrigin origin = IntSlabsRaySetup(c.ray, unit.bits).ray().origin;
    EXPECT_TRUE(differences_fit(box, coarse_origin(origin, unit.coarse, unit.bits.coord), unit.bits.coord))
        << to_text(c);
    const bool hit = unit.hit(c.ray, box, unit.coarse);
    ++judged.cases;
    judged.as_they_come += as_it_comes ? 1 : 0;
    judged.hits += meets ? 1 : 0;
    judged.false_hits += hit && !meets ? 1 : 0;
    if (hit || !meets) continue;
    if (judged.false_misses++ == 0) {
      ADD_FAILURE() << "false miss at " << unit.bits.coord << "/" << unit.bits.interval << ", coarse "
                    << to_text(unit.coarse) << ": " << to_text(c);
    }
  }
  return judged;
}

/// Every ray, first as it is and then without an end.
std::vector<Case> cases_of(const Category& category, int cases_per_category) {
  adversary::Random random(seed);
  std::vector<Case> cases;
  for (int i = 0; i < cases_per_category; ++i) {
    cases.push_back(category.make(random));
    cases.push_back(cases.back());
    cases.back().ray.length = Ray::infinite;
  }
  return cases;
}

void expect_no_false_miss(std::span<const Unit> units, int cases_per_category) {
  std::printf("seed %llu\n%9s %9s %9s %9s %9s  format, dropped bits, category\n",
              static_cast<unsigned long long>(seed), "cases", "as drawn", "hits", "false", "missed");
  long long run = 0;
  for (const Category& category : adversary::categories()) {
    const std::vector<Case> cases = cases_of(category, cases_per_category);
    std::vector<bool> expected;
    for (const Case& c : cases) expected.push_back(ray_meets_box(c.ray, c.box));
    for (const Unit& unit : units) {
      const Judged judged = judge(unit, cases, expected);
      std::printf("%9d %9d %9d %9d %9d  %d/%d, %s, %s\n", judged.cases, judged.as_they_come, judged.hits,
                  judged.false_hits, judged.false_misses, unit.bits.coord, unit.bits.interval,
                  to_text(unit.coarse).c_str(), std::string(category.name).c_str());
      EXPECT_EQ(judged.cases, 2 * cases_per_category);
      EXPECT_EQ(judged.false_misses, 0) << category.name;
      EXPECT_GT(judged.hits, judged.cases / 25) << category.name;
      run += judged.cases;
      if (category.name == "random") {
        EXPECT_LE(judged.false_hits, judged.cases * unit.most_false_hits_pct / 100)
            << unit.bits.coord << "/" << unit.bits.interval;
      }
    }
  }
  EXPECT_EQ(run, 27LL * static_cast<long long>(units.size()) * 2 * cases_per_category);
}

TEST(NoFalseMiss, IntSlabsInEveryCategoryAndFormat) {
  expect_no_false_miss(units_of<NativeSlabs>, 20'000);
}

TEST(NoFalseMiss, IntPluckerInEveryCategoryAndFormat) {
  expect_no_false_miss(units_of<NativePlucker>, 20'000);
}

TEST(NoFalseMiss, IntSlabsOnCoarseAxesInEveryCategory) {
  expect_no_false_miss(coarse_units_of<NativeSlabs>, 4'000);
}

TEST(NoFalseMiss, IntPluckerOnCoarseAxesInEveryCategory) {
  expect_no_false_miss(coarse_units_of<NativePlucker>, 4'000);
}

}  // namespace
}  // namespace hitpipe::ref::false_miss_test
