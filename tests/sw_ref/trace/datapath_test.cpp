// The box tests with run-time formats answer as the datapaths of hls/ do: on every category of the adversary,
// on boxes near the ray on the grid, after a cut, and on coarser axes.
#include <algorithm>
#include <cstdint>
#include <span>
#include <stdexcept>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "rays/exact/grid.hpp"
#include "rays/trace/int_major.hpp"
#include "sw_ref/trace/int_plucker.hpp"
#include "sw_ref/trace/int_slabs.hpp"
#include "tests/message_of.hpp"
#include "tests/sw_ref/judge/adversary/each_case.hpp"
#include "tests/sw_ref/quantise/major_formats.hpp"
#include "tests/sw_ref/quantise/major_operands.hpp"
#include "tests/sw_ref/quantise/native_units.hpp"

namespace hitpipe::ref::datapath_test {
namespace {

using adversary::Random;
using hls::IntBits;
using hls::MajorBits;
using hls::MajorFormat;

constexpr std::uint64_t seed = 20046;
constexpr int boxes_per_ray = 8;  ///< the first is the case's own

/// A box around a point of the ray, moved by up to a few of its sides.
IntBox box_near(const Ray& ray, int coord_bits, Random& random) {
  const auto limit = grid_limit(coord_bits);
  const float t = std::abs(random.signed_unit()) * 2.0F;
  const int side_bits = random.between(0, coord_bits - 2);
  IntBox box;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<int>(i);
    const double at = static_cast<double>(ray.origin[axis]) + t * static_cast<double>(ray.direction[axis]);
    const auto centre =
        static_cast<std::int64_t>(std::clamp(at, -1.0, 1.0) * static_cast<double>(grid_scale(coord_bits)));
    const auto reach = (std::uint64_t{1} << side_bits) + 1;
    const std::int64_t a = centre - static_cast<std::int64_t>(random.below(reach));
    const std::int64_t b = centre + static_cast<std::int64_t>(random.below(reach)) - (random.coin() ? 1 : 0);
    box.min[i] = static_cast<std::int32_t>(std::clamp(std::min(a, b), -limit, limit));
    box.max[i] = static_cast<std::int32_t>(std::clamp(std::max(a, b), -limit, limit));
  }
  return box;
}

struct Tally {
  int vectors = 0, hits = 0;

  void expect_both_answers() const {
    EXPECT_GT(hits, vectors / 10);
    EXPECT_LT(hits, vectors * 9 / 10);
  }
};

/// Compares `test`, whole and cut, with datapath(ray, box).
template <class Test, class Datapath>
void compare(Test test, const adversary::Case& c, int coord_bits, int finer, Random& random, Tally& tally,
             const Datapath& datapath) {
  // Cut where boxes are, so that the length decides.
  Ray shorter = c.ray;
  shorter.length = std::min(c.ray.length, std::abs(random.signed_unit()) * 2.0F);
  Test cut_test = test;
  cut_test.cut(shorter.length);
  for (int b = 0; b < boxes_per_ray; ++b) {
    const IntBox box = b == 0 && coord_bits >= IntBits::min_coord ? quantise_box(c.box, coord_bits, finer)
                                                                  : box_near(c.ray, coord_bits, random);
    for (const bool cut : {false, true}) {
      const bool hit = datapath(cut ? shorter : c.ray, box);
      EXPECT_EQ((cut ? cut_test : test)(box), hit)
          << fmt::format("{} bits, cut {}: box {:#x} {:#x} {:#x} to {:#x} {:#x} {:#x}", coord_bits, cut,
                         box.min[0], box.min[1], box.min[2], box.max[0], box.max[1], box.max[2]);
      ++tally.vectors;
      tally.hits += hit ? 1 : 0;
    }
  }
}

template <class Maker>
void compare_with(std::span<const NativeUnit> units) {
  for (const NativeUnit& unit : units) {
    SCOPED_TRACE(unit.name());
    const Maker make_test(unit.bits, unit.coarse);
    Random random(seed);
    Tally tally;
    adversary::each_case(random, 250, [&](const adversary::Case& drawn) {
      const adversary::Case c = unit.coarse.any() ? adversary::halved(drawn) : drawn;
      compare(make_test(c.ray), c, unit.bits.coord, 0, random, tally,
              [&](const Ray& ray, const IntBox& box) { return unit.hit(ray, box, unit.coarse); });
    });
    tally.expect_both_answers();
  }
}

TEST(IntSlabsTest, SaysWhatTheDatapathSays) {
  compare_with<IntSlabsTestMaker>(native_units<NativeSlabs>);
}

TEST(IntPluckerTest, SaysWhatTheDatapathSays) {
  compare_with<IntPluckerTestMaker>(native_units<NativePlucker>);
}

template <class D, class F>
void compare_major(const F& format, const adversary::Case& c, Random& random, Tally& tally) {
  const MajorBits bits = format;
  SCOPED_TRACE(name_of(bits));
  const IntMajorRaySetup set_up(c.ray, bits);
  compare(IntMajorTest(c.ray, bits), c, bits.coord, bits.finer, random, tally,
          [&](const Ray& ray, const IntBox& box) {
            MajorOperandValues values{};
            put_ray(set_up, ray.length, values);
            put_planes(box, values);
            const MajorAnswer answer = major_answer<D>(format, values);
            EXPECT_EQ(answer.out_of_range, 0);
            return answer.hit;
          });
}

TEST(IntMajorTest, SaysWhatTheDatapathSaysInEveryFormat) {
  Random random(seed);
  Tally tally;
  adversary::each_case(random, 1'000, [&](const adversary::Case& c) {
    compare_major<hls::Sized>(
        major_bits(random, random.between(MajorBits::min_proved_coord, MajorBits::max_coord),
                   random.between(0, MajorBits::max_finer)),
        c, random, tally);
  });
  tally.expect_both_answers();
}

template <class F>
void compare_with_native() {
  Random random(seed + 1);
  Tally tally;
  adversary::each_case(random, 300,
                       [&](const adversary::Case& c) { compare_major<hls::Native>(F(), c, random, tally); });
  tally.expect_both_answers();
}

TEST(IntMajorTest, SaysWhatTheDatapathSaysInBuiltInFormats) {
  compare_with_native<MajorFormat<20, 1, 13>>();
  compare_with_native<MajorFormat<6, 0, 4>>();
  compare_with_native<MajorFormat<8, 3, 6, -1>>();
  compare_with_native<MajorFormat<12, 2, 10, 3>>();
  compare_with_native<MajorFormat<32, 3, 28>>();
}

/// A shift that saturates on either side: n = 8, g = 1, so a difference has 9 bits. A component of 2^-8 has
/// the exponent 8, with which -1 still fits and 1 does not.
TEST(IntMajorTest, SaturatedDistancesLieBeforeTheRayOrBehindItsLastPoint) {
  const auto hit = [&](int low, int high, int from, int to) {
    // x 0 .. 0 holds the origin's slab of the third axis; the ray goes up z.
    const IntMajorTest test({{}, {0, 0x1p-8F, 1}, Ray::infinite}, {8, 1, 6});
    return test(IntBox{{-1, low, from}, {1, high, to}});
  };
  EXPECT_TRUE(hit(-1, 1, 0, 64));    // from -saturated to saturated
  EXPECT_FALSE(hit(1, 2, 0, 64));    // the near plane saturates: beyond the cube
  EXPECT_FALSE(hit(-2, -1, 0, 64));  // the far plane saturates below 0: behind
  EXPECT_TRUE(hit(0, 1, 0, 64));     // a difference of 0 is a distance of 0
  EXPECT_TRUE(hit(-64, 64, 64, 64));
}

template <class Maker>
std::string refusal(IntBits bits, const CoarseAxes& coarse = {}) {
  return message_of<std::invalid_argument>([&] { Maker(bits, coarse); });
}

TEST(IntTestMakers, FormatsAndDroppedBitsThatNoUnitHasAreRejected) {
  EXPECT_EQ(refusal<IntSlabsTestMaker>({33, 24}),
            "IntSlabsTestMaker: format 33/24; n must be 6 to 32 and t 6 to 2n-1");
  EXPECT_EQ(refusal<IntPluckerTestMaker>({16, 32}),
            "IntPluckerTestMaker: format 16/32; n must be 6 to 32 and t 6 to 2n-1");
  EXPECT_EQ(refusal<IntPluckerTestMaker>({16, 31}), "no exception");
  EXPECT_EQ(refusal<IntSlabsTestMaker>({16, 16}, {{0, 15, 0}}),
            "IntSlabsTestMaker: 15 dropped bits of y; of 16 bits 0 to 14 can be dropped");
  EXPECT_EQ(refusal<IntPluckerTestMaker>({16, 16}, {{0, 0, -1}}),
            "IntPluckerTestMaker: -1 dropped bits of z; of 16 bits 0 to 14 can be dropped");
}

}  // namespace
}  // namespace hitpipe::ref::datapath_test
