// The integer box tests of run-time n/t say what the datapaths of hls/ say: on every category of the
// adversary, on boxes drawn near the ray on the grid, and after a cut; on coarser axes too.
#include <array>
#include <cstdint>
#include <cstdio>
#include <stdexcept>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hls/num/domain.hpp"
#include "hls/pipelines/int_plucker.hpp"
#include "hls/pipelines/int_slabs.hpp"
#include "sw_ref/adversary/categories.hpp"
#include "sw_ref/quantise/coarse_axes.hpp"
#include "sw_ref/quantise/grid.hpp"
#include "sw_ref/quantise/int_box.hpp"
#include "sw_ref/traverse/int_plucker.hpp"
#include "sw_ref/traverse/int_slabs.hpp"
#include "tests/sw_ref/adversary/halved.hpp"

namespace hitpipe::ref {
namespace {

using adversary::Random;
using hls::IntBits;
using hls::IntFormat;

constexpr std::uint64_t seed = 20046;
constexpr int rays_per_category = 500;
constexpr int boxes_per_ray = 8;  ///< the first is the case's own, for the ray as it comes and cut
constexpr int vectors = 27 * rays_per_category * boxes_per_ray * 2;

template <class Operands>
void set_box(Operands& in, const IntBox& box) {
  in.ixmin = box.min[0];
  in.ixmax = box.max[0];
  in.iymin = box.min[1];
  in.iymax = box.max[1];
  in.izmin = box.min[2];
  in.izmax = box.max[2];
}

template <class F>
struct Slabs {
  static bool hit(const Ray& exact, const IntBox& box, const CoarseAxes& coarse) {
    const IntRay ray = IntRaySetup(exact, F::bits).ray();
    const IntOrigin origin = coarse_origin(ray.origin, coarse, F::bits.coord);
    hls::IntSlabsOperands<hls::Native, F> in;
    in.irx = origin[0];
    in.iry = origin[1];
    in.irz = origin[2];
    in.irlen = ray.length;
    in.iri_floor = ray.irdvc_floor[0];
    in.iri_ceil = ray.irdvc_ceil[0];
    in.irj_floor = ray.irdvc_floor[1];
    in.irj_ceil = ray.irdvc_ceil[1];
    in.irk_floor = ray.irdvc_floor[2];
    in.irk_ceil = ray.irdvc_ceil[2];
    in.rinf = ray.infinite;
    set_box(in, box);
    return hls::IntSlabs::test(F(), in).hit.to_bool();
  }
};

template <class F>
struct Plucker {
  static bool hit(const Ray& exact, const IntBox& box, const CoarseAxes& coarse) {
    const IntPluckerRay ray = IntPluckerSetup(exact, F::bits).ray();
    const IntOrigin origin = coarse_origin(ray.origin, coarse, F::bits.coord);
    hls::IntPluckerOperands<hls::Native, F> in;
    in.irx = origin[0];
    in.iry = origin[1];
    in.irz = origin[2];
    in.irex = ray.end.at[0];
    in.irey = ray.end.at[1];
    in.irez = ray.end.at[2];
    in.iri = ray.direction[0];
    in.irj = ray.direction[1];
    in.irk = ray.direction[2];
    in.rinf = ray.end.infinite;
    set_box(in, box);
    return hls::IntPlucker::test(F(), in).hit.to_bool();
  }
};

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

/// A box around a point of the ray, moved by up to a few of its sides: edges and faces near the ray.
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
  compare_with<IntSlabsSetUp>(units_of<Slabs>);
}

TEST(IntBoxTest, PluckerSaysWhatTheDatapathSays) {
  compare_with<IntPluckerSetUp>(units_of<Plucker>);
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
  EXPECT_EQ(refusal<IntSlabsSetUp>({33, 24}),
            "IntSlabsSetUp: format 33/24; n must be 6 to 32 and t 6 to 2n-1");
  EXPECT_EQ(refusal<IntPluckerSetUp>({16, 32}),
            "IntPluckerSetUp: format 16/32; n must be 6 to 32 and t 6 to 2n-1");
  EXPECT_EQ(refusal<IntPluckerSetUp>({16, 31}), "accepted");
}

TEST(IntBoxTest, MoreDroppedBitsThanACoordinateHasAreRejected) {
  EXPECT_EQ(refusal<IntSlabsSetUp>({16, 16}, {{0, 15, 0}}),
            "IntSlabsSetUp: 15 dropped bits of y; of 16 bits 0 to 14 can be dropped");
  EXPECT_EQ(refusal<IntPluckerSetUp>({16, 16}, {{0, 0, -1}}),
            "IntPluckerSetUp: -1 dropped bits of z; of 16 bits 0 to 14 can be dropped");
}

}  // namespace
}  // namespace hitpipe::ref
