// The integer box tests with run-time n/t answer as the datapaths of hls/ do: on every category of the
// adversary, on random boxes near the ray on the grid, after a cut, and on coarser axes.
#include <array>
#include <cstdint>
#include <cstdio>
#include <stdexcept>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sw_ref/judge/adversary/categories.hpp"
#include "sw_ref/quantise/coarse_axes.hpp"
#include "sw_ref/quantise/int_box.hpp"
#include "sw_ref/trace/int_plucker.hpp"
#include "sw_ref/trace/int_slabs.hpp"
#include "tests/sw_ref/judge/adversary/halved.hpp"
#include "tests/sw_ref/quantise/native_units.hpp"
#include "tests/sw_ref/trace/box_near.hpp"

namespace hitpipe::ref::int_box_test_test {
namespace {

using adversary::Random;
using hls::IntBits;
using hls::IntFormat;

constexpr std::uint64_t seed = 20046;
constexpr int rays_per_category = 500;
constexpr int boxes_per_ray =
    8;  ///< the first is the case's own, tested with the original ray and the cut ray
constexpr int vectors = 27 * rays_per_category * boxes_per_ray * 2;

struct Unit {
  IntBits bits;
  bool (*hit)(const Ray&, const IntBox&, const CoarseAxes&);
  CoarseAxes coarse{};
};

template <template <class> class Design>
constexpr std::array<Unit, 10> units_of{{{{24, 24}, Design<IntFormat<24, 24>>::hit},
                                         {{20, 24}, Design<IntFormat<20, 24>>::hit},
                                         {{16, 16}, Design<IntFormat<16, 16>>::hit},
                                         {{12, 12}, Design<IntFormat<12, 12>>::hit},
                                         {{6, 6}, Design<IntFormat<6, 6>>::hit},
                                         {{4, 4}, Design<IntFormat<4, 4>>::hit},
                                         {{31, 40}, Design<IntFormat<31, 40>>::hit},
                                         {{32, 63}, Design<IntFormat<32, 63>>::hit},
                                         {{16, 16}, Design<IntFormat<16, 16>>::hit, {{0, 9, 2}}},
                                         {{12, 12}, Design<IntFormat<12, 12>>::hit, {{3, 0, 1}}}}};

std::string describe(const Ray& ray, const IntBox& box, IntBits bits) {
  return fmt::format("{}/{}: {}, box {:#x} {:#x} {:#x} to {:#x} {:#x} {:#x}", bits.coord, bits.interval,
                     adversary::to_text(ray), box.min[0], box.min[1], box.min[2], box.max[0], box.max[1],
                     box.max[2]);
}

struct Tally {
  int vectors = 0, hits = 0;
};

template <class SetUp>
void compare(const Unit& unit, const adversary::Category& category, Random& random, Tally& tally) {
  const SetUp set_up(unit.bits, unit.coarse);
  for (int i = 0; i < rays_per_category; ++i) {
    adversary::Case c = category.make(random);
    if (unit.coarse.any()) c = adversary::halved(c);
    // Cut where boxes are, so that the length decides.
    Ray shorter = c.ray;
    shorter.length = std::min(c.ray.length, std::abs(random.signed_unit()) * 2.0F);
    const auto whole_test = set_up(c.ray);
    auto cut_test = whole_test;
    cut_test.cut(shorter.length);
    for (int b = 0; b < boxes_per_ray; ++b) {
      const IntBox box = b == 0 && unit.bits.coord >= IntBits::min_coord
                             ? quantise_box(c.box, unit.bits.coord)
                             : box_near(c.ray, unit.bits.coord, random);
      const bool whole = unit.hit(c.ray, box, unit.coarse);
      const bool cut = unit.hit(shorter, box, unit.coarse);
      ASSERT_EQ(whole_test(box), whole) << category.name << ", " << describe(c.ray, box, unit.bits);
      ASSERT_EQ(cut_test(box), cut) << category.name << ", cut, " << describe(shorter, box, unit.bits);
      tally.vectors += 2;
      tally.hits += (whole ? 1 : 0) + (cut ? 1 : 0);
    }
  }
}

template <class SetUp>
void compare_with(std::span<const Unit> units) {
  for (const Unit& unit : units) {
    Random random(seed);
    Tally tally;
    for (const adversary::Category& category : adversary::categories()) {
      ASSERT_NO_FATAL_FAILURE(compare<SetUp>(unit, category, random, tally));
    }
    std::printf("seed %llu, %d/%d, dropped bits %s: %d vectors, %d hits\n",
                static_cast<unsigned long long>(seed), unit.bits.coord, unit.bits.interval,
                to_text(unit.coarse).c_str(), tally.vectors, tally.hits);
    EXPECT_EQ(tally.vectors, vectors);
    EXPECT_GT(tally.hits, vectors / 10);
    EXPECT_LT(tally.hits, vectors * 9 / 10);
  }
}

static_assert(vectors >= 100'000);

TEST(IntBoxTest, SlabsSayWhatTheDatapathSays) {
  compare_with<IntSlabsTestMaker>(units_of<NativeSlabs>);
}

TEST(IntBoxTest, PluckerSaysWhatTheDatapathSays) {
  compare_with<IntPluckerTestMaker>(units_of<NativePlucker>);
}

template <class SetUp>
std::string refusal(IntBits bits, const CoarseAxes& coarse = {}) {
  try {
    const SetUp set_up(bits, coarse);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(IntBoxTest, FormatsThatNoUnitHasAreRejected) {
  EXPECT_EQ(refusal<IntSlabsTestMaker>({33, 24}),
            "IntSlabsTestMaker: format 33/24; n must be 6 to 32 and t 6 to 2n-1");
  EXPECT_EQ(refusal<IntPluckerTestMaker>({16, 32}),
            "IntPluckerTestMaker: format 16/32; n must be 6 to 32 and t 6 to 2n-1");
  EXPECT_EQ(refusal<IntPluckerTestMaker>({16, 31}), "accepted");
}

TEST(IntBoxTest, MoreDroppedBitsThanACoordinateHasAreRejected) {
  EXPECT_EQ(refusal<IntSlabsTestMaker>({16, 16}, {{0, 15, 0}}),
            "IntSlabsTestMaker: 15 dropped bits of y; of 16 bits 0 to 14 can be dropped");
  EXPECT_EQ(refusal<IntPluckerTestMaker>({16, 16}, {{0, 0, -1}}),
            "IntPluckerTestMaker: -1 dropped bits of z; of 16 bits 0 to 14 can be dropped");
}

}  // namespace
}  // namespace hitpipe::ref::int_box_test_test
