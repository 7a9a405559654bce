// The C++ of the integer units never misses a box that the exact referee hits, in every category and format,
// with finite and infinite rays, also on coarser axes.
#include <array>
#include <cstdint>
#include <span>

#include <gtest/gtest.h>

#include "rays/exact/box_referee.hpp"
#include "rays/world/coarse_axes.hpp"
#include "rays/world/int_box.hpp"
#include "sw_ref/judge/adversary/generators.hpp"
#include "sw_ref/quantise/int_plucker_ray.hpp"
#include "sw_ref/quantise/int_slabs_ray.hpp"
#include "tests/sw_ref/judge/adversary/each_case.hpp"
#include "tests/sw_ref/quantise/native_units.hpp"

namespace hitpipe::ref::false_miss_test {
namespace {

using adversary::Case;

constexpr std::uint64_t seed = 20072;

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

bool hit(const NativeUnit& unit, const Case& c) {
  const int n = unit.bits.coord;
  const IntBox box = coarse_box(quantise_box(c.box, n), unit.coarse, n);
  const IntOrigin origin = IntSlabsRaySetup(c.ray, unit.bits).ray().origin;
  EXPECT_TRUE(differences_fit(box, coarse_origin(origin, unit.coarse, n), n));
  return unit.hit(c.ray, box, unit.coarse);
}

/// A unit that always hits would never miss. Coarse grids and few bits of an interval hit more.
int most_false_hits_pct(hls::IntBits bits) {
  const int least = std::min(bits.coord, bits.interval);
  return least <= 6 ? 50 : least <= 8 ? 15 : 1;
}

/// Every ray as it is and without an end. That the referee hits and misses is asserted in
/// categories_test.cpp.
void expect_no_false_miss(std::span<const NativeUnit> units) {
  for (const NativeUnit& unit : units) {
    SCOPED_TRACE(unit.name());
    adversary::Random random(seed);
    adversary::each_case(random, 4'000, [&](const Case& drawn) {
      Case c = unit.fitting(drawn);
      for (const float length : {c.ray.length, Ray::infinite}) {
        c.ray.length = length;
        EXPECT_TRUE(hit(unit, c) || !ray_meets_box(c.ray, c.box)) << "length " << length;
      }
    });
    constexpr int count = 20'000;
    int false_hits = 0;
    for (int i = 0; i < count; ++i) {
      const Case c = unit.fitting(adversary::random_case(random));
      false_hits += hit(unit, c) && !ray_meets_box(c.ray, c.box) ? 1 : 0;
    }
    EXPECT_LE(false_hits, count * most_false_hits_pct(unit.bits) / 100);
  }
}

TEST(NoFalseMiss, IntSlabsInEveryCategoryAndFormat) {
  expect_no_false_miss(native_units<NativeSlabs>);
}

TEST(NoFalseMiss, IntPluckerInEveryCategoryAndFormat) {
  expect_no_false_miss(native_units<NativePlucker>);
}

}  // namespace
}  // namespace hitpipe::ref::false_miss_test
