// Coarser axes: every origin and plane of narrow grids, and coordinates that do not fit.
#include "rays/world/coarse_axes.hpp"

#include <stdexcept>

#include <gtest/gtest.h>

#include "rays/exact/grid.hpp"
#include "tests/message_of.hpp"

namespace hitpipe::ref::coarse_axes_test {
namespace {

IntOrigin all(std::int64_t coordinate) {
  const auto c = static_cast<std::int32_t>(coordinate);
  return {c, c, c};
}

/// The results for an origin, a lower plane and an upper plane of one axis.
struct Axis {
  int coord_bits;
  CoarseAxes coarse;

  [[nodiscard]] std::int64_t origin(std::int64_t io) const {
    return coarse_origin(all(io), coarse, coord_bits)[1];
  }
  [[nodiscard]] IntBox planes(std::int64_t at) const {
    return coarse_box({all(at), all(at)}, coarse, coord_bits);
  }
};

TEST(CoarseAxes, HoldFromTheCutOriginWhatIsHeldFromTheRoundedOne) {
  std::int64_t pairs = 0;
  for (int n = 6; n <= 9; ++n) {
    const std::int64_t scale = grid_scale(n);
    const std::int64_t limit = grid_limit(n);
    for (int k = 0; k <= n - 3; ++k) {
      const Axis axis{n, {{0, k, 0}}};
      const std::int64_t unit = std::int64_t{1} << k;
      for (std::int64_t at = -limit + 2 * unit - 2; at <= limit; ++at) {
        const IntBox box = axis.planes(at);
        EXPECT_EQ(box.min[0], at);
        EXPECT_EQ(box.max[2], at);
        const std::int64_t min = box.min[1];
        const std::int64_t max = box.max[1];
        EXPECT_TRUE(min % unit == 0 && max % unit == 0);
        EXPECT_TRUE(min >= -limit && max <= limit);
        // The next multiple inside would be wrong for some origin.
        EXPECT_GT(min + unit + unit - 1, at);
        EXPECT_LT(max - unit, at);
        for (std::int64_t io = -scale / unit * unit; io <= scale; ++io) {
          const std::int64_t cut = axis.origin(io);
          ASSERT_TRUE(cut % unit == 0 && cut >= -scale && cut <= io);
          ASSERT_LE(min - cut, at - io) << n << " bits, k = " << k;
          ASSERT_GE(max - cut, at - io) << n << " bits, k = " << k;
          ++pairs;
        }
      }
    }
  }
  EXPECT_EQ(pairs, 475'332);
}

TEST(CoarseAxes, WithoutADroppedBitChangeNothing) {
  const IntBox box{{-16384, -1, 4095}, {-8191, 16384, 8192}};
  EXPECT_EQ(coarse_box(box, {}, 16), box);
  EXPECT_EQ(coarse_origin({-16383, 0, 16383}, {}, 16), (IntOrigin{-16383, 0, 16383}));
}

TEST(CoarseAxes, FitTheGridJustWhenNothingIsThrown) {
  constexpr int n = 6;
  int fitting = 0;
  for (int k = 0; k <= n - 2; ++k) {
    for (std::int64_t io = -grid_scale(n); io <= grid_scale(n); ++io) {
      for (std::int64_t at = -grid_limit(n); at <= grid_limit(n); ++at) {
        const Axis axis{n, {{0, k, 0}}};
        bool thrown = false;
        try {
          (void)axis.origin(io);
          (void)axis.planes(at);
        } catch (const std::out_of_range&) {
          thrown = true;
        }
        ASSERT_EQ(fits_grid(all(io), {all(at), all(at)}, axis.coarse, n), !thrown)
            << k << " " << io << " " << at;
        fitting += thrown ? 0 : 1;
      }
    }
  }
  EXPECT_GT(fitting, 1'000);
  EXPECT_LT(fitting, 5 * 31 * 33);
}

TEST(CoarseAxes, ThatLeaveTheGridAreRejected) {
  const CoarseAxes coarse{{0, 0, 3}};
  EXPECT_EQ(message_of<std::out_of_range>([&] { (void)coarse_origin(all(-4095), coarse, 14); }),
            "coarse axes: origin.z = -4096 leaves the 14-bit grid; drop fewer than 3 low bits of z");
  EXPECT_EQ(message_of<std::out_of_range>([&] {
              (void)coarse_box({all(-4090), all(0)}, coarse, 14);
            }),
            "coarse axes: min.z = -4104 leaves the 14-bit grid; drop fewer than 3 low bits of z");
  EXPECT_EQ(message_of<std::out_of_range>([&] {
              (void)coarse_box({all(0), all(17)}, {{4, 0, 0}}, 6);
            }),
            "coarse axes: max.x = 32 leaves the 6-bit grid; drop fewer than 4 low bits of x");
}

TEST(CoarseAxes, OfMoreBitsThanThereAreAreRejected) {
  const auto check = [](int k, int n) {
    return message_of<std::invalid_argument>([&] { check_coarse({{0, k, 0}}, n, "check"); });
  };
  EXPECT_EQ(check(12, 14), "no exception");
  EXPECT_EQ(check(13, 14), "check: 13 dropped bits of y; of 14 bits 0 to 12 can be dropped");
  EXPECT_EQ(check(-1, 14), "check: -1 dropped bits of y; of 14 bits 0 to 12 can be dropped");
}

TEST(CoarseAxes, AreNamedWithTheirBits) {
  EXPECT_EQ(to_text(CoarseAxes{}), "none");
  EXPECT_EQ(to_text(CoarseAxes{{0, 0, 2}}), "z 2");
  EXPECT_EQ(to_text(CoarseAxes{{3, 0, 12}}), "x 3, z 12");
}

}  // namespace
}  // namespace hitpipe::ref::coarse_axes_test
