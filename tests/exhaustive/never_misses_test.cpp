// Every ray and box of the sweeps, for n = 4 and 5, every t, slabs and Pluecker, also on coarser axes, and
// narrow units with a major axis: there is no false miss.
#include <bit>
#include <cstdint>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "rays/exact/box_referee.hpp"
#include "sw_ref/judge/adversary/case.hpp"
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

/// A bit for each box, 64 in a word.
using Answers = std::vector<std::uint64_t>;

template <class Answer>
Answers answers(std::size_t boxes, Answer answer) {
  Answers words((boxes + 63) / 64);
  for (std::size_t i = 0; i < boxes; ++i) words[i / 64] |= std::uint64_t{answer(i)} << i % 64;
  return words;
}

/// What a unit answers to the boxes of a sweep. Many rays have the same operands; these are sent once.
class Answering {
 public:
  Answering(const NarrowUnit& unit, const std::vector<Aabb>& boxes, const CoarseAxes& coarse)
      : unit_(unit), coarse_(coarse) {
    for (const Aabb& box : boxes)
      boxes_.push_back(coarse_box(narrow_box(box, unit.coord, unit.finer), coarse, unit.coord));
  }
  const Answers& to(const Ray& ray) {
    Operands operands{};
    unit_.set_up(ray, unit_.format, operands.data());
    cut_origin(coarse_, unit_.coord, operands.data());
    const auto [known, is_new] = known_.try_emplace(operands);
    if (is_new) {
      known->second = answers(boxes_.size(), [&](std::size_t i) {
        put_box(boxes_[i], operands.data() + unit_.ray_operands);
        return unit_.evaluate(operands.data());
      });
    }
    return known->second;
  }

 private:
  const NarrowUnit& unit_;
  CoarseAxes coarse_;
  std::vector<IntBox> boxes_;
  std::map<Operands, Answers> known_;
};

void judge(const NarrowUnit& unit, const Ray& ray, const std::vector<Aabb>& boxes, const Answers& hit,
           const Answers& meets, Counts& counts) {
  counts.tests += boxes.size();
  for (std::size_t word = 0; word < meets.size(); ++word) {
    counts.hits += static_cast<std::uint64_t>(std::popcount(meets[word]));
    counts.false_hits += static_cast<std::uint64_t>(std::popcount(hit[word] & ~meets[word]));
    const std::uint64_t missed = meets[word] & ~hit[word];
    if (missed != 0 && counts.false_misses == 0) {
      const Aabb& box = boxes[64 * word + static_cast<std::size_t>(std::countr_zero(missed))];
      ADD_FAILURE() << unit.design.name << " " << to_string(unit.format)
                    << " misses: " << adversary::to_text(adversary::Case{ray, box});
    }
    counts.false_misses += static_cast<std::uint64_t>(std::popcount(missed));
  }
}

/// Judges all units over a sweep. Each must have this many tests and exact hits.
void expect_no_false_miss(const std::vector<NarrowUnit>& units, const Sweep& sweep, std::uint64_t tests,
                          std::uint64_t hits, const CoarseAxes& coarse = {}) {
  const std::vector<Aabb> all_boxes = boxes(sweep.corners);
  std::vector<Answering> answering;
  for (const NarrowUnit& unit : units) answering.emplace_back(unit, all_boxes, coarse);
  std::vector<Counts> counts(units.size());
  for (const Ray& ray : sweep.rays()) {
    const BoxReferee referee(ray);
    const Answers meets =
        answers(all_boxes.size(), [&](std::size_t i) { return referee.meets(all_boxes[i]); });
    for (std::size_t u = 0; u < units.size(); ++u)
      judge(units[u], ray, all_boxes, answering[u].to(ray), meets, counts[u]);
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
