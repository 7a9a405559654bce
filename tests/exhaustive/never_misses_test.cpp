// Every ray and box of the sweeps, for n = 4 and 5, every t, slabs and Pluecker, also on coarser axes, and
// narrow units with a major axis: there is no false miss.
#include <cstdint>
#include <cstdio>
#include <string>

#include <gtest/gtest.h>

#include "sw_ref/adversary/case.hpp"
#include "sw_ref/exact/box_referee.hpp"
#include "tests/exhaustive/narrow_unit.hpp"
#include "tests/exhaustive/sweep.hpp"

namespace hitpipe::ref::exhaustive {
namespace {

struct Counts {
  std::uint64_t tests = 0;
  std::uint64_t hits = 0;  ///< by the exact referee
  std::uint64_t false_hits = 0;
  std::uint64_t false_misses = 0;
};

void judge(const NarrowUnit& unit, const Ray& ray, const std::vector<Aabb>& boxes,
           const std::vector<IntBox>& rounded, const std::vector<char>& meets, const CoarseAxes& coarse,
           Counts& counts) {
  Operands operands{};
  unit.set_up(ray, unit.format, operands.data());
  cut_origin(coarse, unit.coord, operands.data());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    put_box(rounded[i], operands.data() + unit.ray_operands);
    const bool hit = unit.evaluate(operands.data());
    ++counts.tests;
    counts.hits += meets[i] != 0 ? 1 : 0;
    counts.false_hits += hit && meets[i] == 0 ? 1 : 0;
    if (hit || meets[i] == 0) continue;
    if (counts.false_misses++ == 0) {
      ADD_FAILURE() << unit.design.name << " " << to_string(unit.format)
                    << " misses: " << adversary::to_text(adversary::Case{ray, boxes[i]});
    }
  }
}

/// Judges all units over a sweep. Each must have this many tests and exact hits.
void expect_no_false_miss(const std::vector<NarrowUnit>& units, const Sweep& sweep, std::uint64_t tests,
                          std::uint64_t hits, const CoarseAxes& coarse = {}) {
  const std::vector<Aabb> all_boxes = boxes(sweep.corners);
  std::vector<std::vector<IntBox>> rounded(units.size());
  for (std::size_t u = 0; u < units.size(); ++u) {
    const int n = units[u].coord;
    for (const Aabb& box : all_boxes)
      rounded[u].push_back(coarse_box(narrow_box(box, n, units[u].finer), coarse, n));
  }
  std::vector<Counts> counts(units.size());
  std::vector<char> meets(all_boxes.size());
  for (const Ray& ray : sweep.rays()) {
    const BoxReferee referee(ray);
    for (std::size_t i = 0; i < all_boxes.size(); ++i) meets[i] = referee.meets(all_boxes[i]) ? 1 : 0;
    for (std::size_t u = 0; u < units.size(); ++u) {
      judge(units[u], ray, all_boxes, rounded[u], meets, coarse, counts[u]);
    }
  }
  std::printf("%12s %10s %10s %7s  unit\n", "tests", "hits", "false", "missed");
  for (std::size_t u = 0; u < units.size(); ++u) {
    const Counts& c = counts[u];
    std::printf("%12llu %10llu %10llu %7llu  %s %s\n", static_cast<unsigned long long>(c.tests),
                static_cast<unsigned long long>(c.hits), static_cast<unsigned long long>(c.false_hits),
                static_cast<unsigned long long>(c.false_misses), std::string(units[u].design.name).c_str(),
                to_string(units[u].format).c_str());
    EXPECT_EQ(c.tests, tests);
    EXPECT_EQ(c.false_misses, 0U);
    EXPECT_EQ(c.hits, hits);
    // A unit that always says HIT would never miss either.
    EXPECT_LT(c.false_hits, (c.tests - c.hits) * 9 / 10);
  }
}

constexpr std::uint64_t endless_tests = 4088ULL * 8 * 1000;
constexpr std::uint64_t ended_tests = 4088ULL * 3 * 1000;
constexpr std::uint64_t leaning_tests = 13816ULL * 8 * 216;

TEST(EveryRayAndBox, FourBitUnitsNeverMissEndlessRays) {
  expect_no_false_miss(units(4), endless, endless_tests, 5'699'544);
}
TEST(EveryRayAndBox, FiveBitUnitsNeverMissEndlessRays) {
  expect_no_false_miss(units(5), endless, endless_tests, 5'699'544);
}
TEST(EveryRayAndBox, FourBitUnitsNeverMissRaysWithAnEnd) {
  expect_no_false_miss(units(4), ended, ended_tests, 2'796'541);
}
TEST(EveryRayAndBox, FiveBitUnitsNeverMissRaysWithAnEnd) {
  expect_no_false_miss(units(5), ended, ended_tests, 2'796'541);
}

/// Slabs have no bound of side relations.
std::vector<NarrowUnit> plucker_of(std::vector<NarrowUnit> units) {
  std::erase_if(units, [](const NarrowUnit& unit) { return unit.design.name != hls::IntPlucker::name; });
  return units;
}
TEST(EveryRayAndBox, FourBitPlueckerUnitsNeverMissWhereTheirDirectionLeans) {
  expect_no_false_miss(plucker_of(units(4)), leaning_4, leaning_tests, 757'090);
}
TEST(EveryRayAndBox, FiveBitPlueckerUnitsNeverMissWhereTheirDirectionLeans) {
  expect_no_false_miss(plucker_of(units(5)), leaning_5, leaning_tests, 41'568);
}

/// The axes do not depend on t, so every second t is enough.
std::vector<NarrowUnit> of_even_t(std::vector<NarrowUnit> units) {
  std::erase_if(units,
                [](const NarrowUnit& unit) { return unit.format.as<hls::IntBits>().interval % 2 != 0; });
  return units;
}
constexpr std::uint64_t inner_tests = 4088ULL * 8 * 2 * 216;

TEST(EveryRayAndBox, FourBitUnitsNeverMissOnCoarseAxes) {
  expect_no_false_miss(of_even_t(units(4)), inner, inner_tests, 1'438'133, {{1, 1, 1}});
  expect_no_false_miss(of_even_t(units(4)), inner, inner_tests, 1'438'133, {{0, 1, 0}});
}
TEST(EveryRayAndBox, FiveBitUnitsNeverMissOnCoarseAxes) {
  expect_no_false_miss(of_even_t(units(5)), inner, inner_tests, 1'438'133, {{1, 0, 2}});
}
TEST(EveryRayAndBox, FiveBitPlueckerUnitsNeverMissOnCoarseAxesWhereTheirDirectionLeans) {
  expect_no_false_miss(of_even_t(plucker_of(units(5))), leaning_5, leaning_tests, 41'568, {{1, 0, 1}});
}

constexpr std::uint64_t tied_tests = 4088ULL * 27 * 216;

/// On the planes' grid, and finer with 4 and 5 bits.
std::vector<NarrowUnit> three_of(const std::vector<NarrowUnit>& units) {
  return {units[0], units[2], units[5]};
}

TEST(EveryRayAndBox, UnitsWithAMajorAxisNeverMissEndlessRays) {
  expect_no_false_miss(three_of(major_units()), endless, endless_tests, 5'699'544);
}
TEST(EveryRayAndBox, UnitsWithAMajorAxisNeverMissRaysWithAnEnd) {
  expect_no_false_miss(major_units(), ended, ended_tests, 2'796'541);
}
TEST(EveryRayAndBox, UnitsWithAMajorAxisNeverMissFromTiesOfTheirGridsAndAtTheirLargestExponents) {
  expect_no_false_miss(major_units(), tied, tied_tests, 4'608'988);
}

TEST(EveryRayAndBox, BoxesAreRoundedAsForTheProgram) {
  for (const Aabb& box : boxes(endless.corners)) {
    EXPECT_EQ(narrow_box(box, 6), quantise_box(box, 6));
    for (int finer = 0; finer <= 3; ++finer)
      EXPECT_EQ(narrow_box(box, 6, finer), quantise_box(box, 6, finer));
  }
}

}  // namespace
}  // namespace hitpipe::ref::exhaustive
