// The box test with a major axis in 64-bit words answers as the datapath of hls/ does, in any format: on
// every category of the adversary, on boxes near the ray on the grid, and after a cut.
#include "sw_ref/trace/int_major.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "sw_ref/judge/adversary/categories.hpp"
#include "tests/sw_ref/quantise/major_formats.hpp"
#include "tests/sw_ref/quantise/major_operands.hpp"
#include "tests/sw_ref/trace/box_near.hpp"

namespace hitpipe::ref::int_major_test {
namespace {

using adversary::Random;
using hls::MajorBits;
using hls::MajorFormat;

constexpr std::uint64_t seed = 20083;
constexpr int boxes_per_ray = 6;  ///< the first is the case's own

struct Tally {
  int vectors = 0, hits = 0;
  int saturated = 0;  ///< vectors in which the shift of a difference saturates
};

std::string describe(const Ray& ray, const IntBox& box, MajorBits bits) {
  return fmt::format("{}: {}, box {:#x} {:#x} {:#x} to {:#x} {:#x} {:#x}", name_of(bits),
                     adversary::to_text(ray), box.min[0], box.min[1], box.min[2], box.max[0], box.max[1],
                     box.max[2]);
}

/// A difference times 2^exponent has more than n + g bits.
bool saturates(const IntMajorRay& ray, const IntBox& box, MajorBits bits) {
  const std::int64_t range = std::int64_t{1} << (bits.coord + bits.finer - 1);
  for (std::size_t slot = 1; slot < 3; ++slot) {
    const auto axis = static_cast<std::size_t>(ray.axes[slot]);
    const std::int64_t origin = ray.backward[slot] ? -ray.origin[slot] - 1 : ray.origin[slot];
    for (const std::int64_t plane : {box.min[axis], box.max[axis]}) {
      const std::int64_t size = std::abs((plane << bits.finer) - origin);
      if (size >> (bits.coord + bits.finer - 1 - ray.quotient[slot - 1].exponent) != 0 && size < range)
        return true;
    }
  }
  return false;
}

/// Compares one ray, whole and cut, with the datapath in format F.
template <class D, class F>
void compare(const F& format, const adversary::Case& c, Random& random, Tally& tally) {
  const MajorBits bits = format;
  // Cut where boxes are, so that the length decides.
  Ray shorter = c.ray;
  shorter.length = std::min(c.ray.length, std::abs(random.signed_unit()) * 2.0F);
  const IntMajorTest whole_test(c.ray, bits);
  IntMajorTest cut_test = whole_test;
  cut_test.cut(shorter.length);
  const IntMajorRaySetup set_up(c.ray, bits);
  MajorOperandValues values{};
  for (int b = 0; b < boxes_per_ray; ++b) {
    const IntBox box = b == 0 && bits.coord >= MajorBits::min_coord
                           ? quantise_box(c.box, bits.coord, bits.finer)
                           : box_near(c.ray, bits.coord, random);
    put_planes(box, values);
    for (const bool cut : {false, true}) {
      const Ray& ray = cut ? shorter : c.ray;
      put_ray(set_up, ray.length, values);
      const MajorAnswer answer = major_answer<D>(format, values);
      ASSERT_EQ(answer.out_of_range, 0) << describe(ray, box, bits);
      ASSERT_EQ((cut ? cut_test : whole_test)(box), answer.hit) << describe(ray, box, bits);
      ++tally.vectors;
      tally.hits += answer.hit ? 1 : 0;
      tally.saturated += saturates(set_up.ray(), box, bits) ? 1 : 0;
    }
  }
}

void expect_both_answers(const Tally& tally, int vectors) {
  std::printf("seed %llu: %d vectors, %d hits, %d saturated\n", static_cast<unsigned long long>(seed),
              tally.vectors, tally.hits, tally.saturated);
  EXPECT_EQ(tally.vectors, vectors);
  EXPECT_GT(tally.hits, vectors / 10);
  EXPECT_LT(tally.hits, vectors * 9 / 10);
  EXPECT_GT(tally.saturated, vectors / 10);
}

TEST(IntMajorTest, SaysWhatTheDatapathSaysInEveryWidth) {
  Random random(seed);
  Tally tally;
  for (int n = MajorBits::min_proved_coord; n <= MajorBits::max_coord; ++n) {
    for (int g = 0; g <= MajorBits::max_finer; ++g) {
      for (const adversary::Category& category : adversary::categories()) {
        for (int i = 0; i < 12; ++i) {
          ASSERT_NO_FATAL_FAILURE(
              compare<hls::Sized>(major_bits(random, n, g), category.make(random), random, tally))
              << category.name;
        }
      }
    }
  }
  expect_both_answers(tally,
                      29 * 4 * 12 * boxes_per_ray * 2 * static_cast<int>(adversary::categories().size()));
}

template <class F>
void compare_with_native() {
  Random random(seed + 1);
  Tally tally;
  for (const adversary::Category& category : adversary::categories()) {
    for (int i = 0; i < 400; ++i) {
      ASSERT_NO_FATAL_FAILURE(compare<hls::Native>(F(), category.make(random), random, tally))
          << category.name;
    }
  }
  expect_both_answers(tally, 400 * boxes_per_ray * 2 * static_cast<int>(adversary::categories().size()));
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
  const MajorBits bits{8, 1, 6};
  const auto hit = [&](float y, int low, int high, int from, int to) {
    // x 0 .. 0 holds the origin's slab of the third axis; the ray goes up z.
    const IntMajorTest test({{0, y, 0}, {0, 0x1p-8F, 1}, Ray::infinite}, bits);
    return test(IntBox{{-1, low, from}, {1, high, to}});
  };
  EXPECT_TRUE(hit(0.0F, -1, 1, 0, 64));    // from -saturated to saturated
  EXPECT_FALSE(hit(0.0F, 1, 2, 0, 64));    // the near plane saturates: beyond the cube
  EXPECT_FALSE(hit(0.0F, -2, -1, 0, 64));  // the far plane saturates below 0: behind
  EXPECT_TRUE(hit(0.0F, 0, 1, 0, 64));     // a difference of 0 is a distance of 0
  EXPECT_TRUE(hit(0.0F, -64, 64, 64, 64));
}

std::string refusal(MajorBits bits) {
  try {
    static_cast<void>(IntMajorTest({{}, {1, 0, 0}, 1}, bits));
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(IntMajorTest, FormatsThatNoUnitHasAreRejected) {
  EXPECT_EQ(refusal({33, 0, 12}), "IntMajorRaySetup: there is no format 33+0/12f0");
  EXPECT_EQ(refusal({20, 1, 12}), "accepted");
}

}  // namespace
}  // namespace hitpipe::ref::int_major_test
