// Rounding to the fine grid of origins, and of planes grown by half its unit, against rational arithmetic.
#include "sw_ref/quantise/fine_grid.hpp"

#include <array>
#include <cstdint>
#include <cstdio>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "sw_ref/quantise/int_box.hpp"
#include "tests/sw_ref/judge/box_cases.hpp"
#include "tests/sw_ref/judge/rational.hpp"

namespace hitpipe::ref::fine_grid_test {
namespace {

using cases::Random;
using oracle::exact;
using oracle::Rational;

constexpr std::uint64_t seed = 20082;

/// G 2^g x.
Rational on_fine_grid(float x, int n, int g) {
  return ((std::int64_t{1} << (n - 2)) - 1) * exact(x) * (1 << g);
}

/// Ties of the fine grid and their neighbours, powers of two down to subnormals, the border, any number.
float coordinate(Random& random, int finer) {
  switch (random.below(6)) {
    case 0: {
      const int odd = 2 * random.between(0, (1 << finer) - 1) + 1;
      const float tie = std::ldexp(static_cast<float>(odd), -(finer + 1));
      return random.sign() * cases::nudged(tie, random.coin() ? 0 : random.between(-1, 1));
    }
    case 1:
      return random.sign() * cases::nudged(std::ldexp(1.0F, -random.between(0, 149)), -random.between(0, 1));
    case 2:
      return random.sign() * cases::nudged(1.0F, -random.between(0, 2));
    case 3:
      return random.signed_zero();
    case 4:
      return random.of_exponent(-40, -1);
    default:
      return random.signed_unit();
  }
}

TEST(FineGrid, RoundsAsRationalsForEveryWidth) {
  std::printf("seed %llu\n", static_cast<unsigned long long>(seed));
  Random random(seed);
  int run = 0;
  for (int n = 4; n <= 32; ++n) {
    for (int g = 0; g <= 3; ++g) {
      for (int i = 0; i < 600; ++i, ++run) {
        const float x = (random.below(8) == 0 ? 2.0F : 1.0F) * coordinate(random, g);
        const Rational fine = on_fine_grid(x, n, g);
        ASSERT_EQ(fine_nearest(x, n, g), oracle::floor(fine + Rational(1) / 2))
            << fmt::format("{:a} n {} g {}", x, n, g);
        ASSERT_EQ(fine_lower(x, n, g), oracle::floor((fine - Rational(1) / 2) / (1 << g)))
            << fmt::format("{:a} n {} g {}", x, n, g);
      }
    }
  }
  EXPECT_EQ(run, 29 * 4 * 600);
}

TEST(FineGrid, IsTheGridWhereItIsNotFiner) {
  Random random(seed + 1);
  for (int n = 6; n <= 32; ++n) {
    for (int i = 0; i < 200; ++i) {
      const float x = coordinate(random, 0);
      ASSERT_EQ(fine_nearest(x, n, 0), grid_floor(x, n, Half::up)) << n;
      ASSERT_EQ(fine_lower(x, n, 0), grid_floor(x, n, Half::down)) << n;
    }
  }
}

TEST(QuantiseBoxForAFinerOrigin, IsTheOutwardRoundedRationalForEveryWidth) {
  Random random(seed + 2);
  int run = 0;
  for (int n = 6; n <= 32; ++n) {
    for (int g = 0; g <= 3; ++g) {
      const Rational half_unit = Rational(1) / (2 << g);
      for (int i = 0; i < 200; ++i) {
        Aabb box;
        box.min = cases::vector_of([&] { return coordinate(random, g); });
        box.max = cases::vector_of([&] { return coordinate(random, g); });
        const IntBox result = quantise_box(box, n, g);
        for (std::size_t axis = 0; axis < 3; ++axis, ++run) {
          const float low = cases::at(box.min, axis);
          const float high = cases::at(box.max, axis);
          ASSERT_EQ(result.min[axis], oracle::floor(on_fine_grid(low, n, 0) - half_unit))
              << fmt::format("{:a} n {} g {}", low, n, g);
          ASSERT_EQ(result.max[axis], oracle::ceil(on_fine_grid(high, n, 0) + half_unit))
              << fmt::format("{:a} n {} g {}", high, n, g);
          ASSERT_LE(std::abs(std::int64_t{result.min[axis]}), grid_limit(n));
          ASSERT_LE(std::abs(std::int64_t{result.max[axis]}), grid_limit(n));
        }
      }
    }
  }
  EXPECT_EQ(run, 27 * 4 * 200 * 3);
}

/// The margin is what keeps a box around what a rounded origin sees, so it shrinks with the origin's error.
TEST(QuantiseBoxForAFinerOrigin, GrowsByHalfAUnitOfThatGrid) {
  // n = 6, G = 15. A third of 15 is on the grid: half a unit of any grid ends in the next unit.
  const float third = 0x1.555554p-2F;  // 15 x = 5 - 2^-22
  const auto upper = [](float x, int g) { return quantise_box({glm::vec3(x), glm::vec3(x)}, 6, g).max[0]; };
  const auto lower = [](float x, int g) { return quantise_box({glm::vec3(x), glm::vec3(x)}, 6, g).min[0]; };
  for (int g = 0; g <= 3; ++g) {
    EXPECT_EQ(upper(third, g), 6) << g;
    EXPECT_EQ(lower(third, g), 4) << g;
  }
  // 15/2 = 7.5, 15/4 = 3.75, 15/8 = 1.875, 15/16 = 0.9375: each ends on the grid with one margin.
  EXPECT_EQ((std::array{upper(0.5F, 0), upper(0.5F, 1), upper(0.5F, 2), upper(0.5F, 3)}),
            (std::array{8, 8, 8, 8}));
  EXPECT_EQ((std::array{upper(0.25F, 0), upper(0.25F, 1), upper(0.25F, 2), upper(0.25F, 3)}),
            (std::array{5, 4, 4, 4}));
  EXPECT_EQ((std::array{upper(0.125F, 0), upper(0.125F, 1), upper(0.125F, 2), upper(0.125F, 3)}),
            (std::array{3, 3, 2, 2}));
  EXPECT_EQ((std::array{upper(0.0625F, 0), upper(0.0625F, 1), upper(0.0625F, 2), upper(0.0625F, 3)}),
            (std::array{2, 2, 2, 1}));
  EXPECT_EQ((std::array{lower(-0.0625F, 0), lower(-0.0625F, 1), lower(-0.0625F, 2), lower(-0.0625F, 3)}),
            (std::array{-2, -2, -2, -1}));
}

TEST(QuantiseBoxForAFinerOrigin, DifferenceToAnyOriginInTheCubeFitsTheWidth) {
  for (int n = 6; n <= 32; ++n) {
    for (int g = 0; g <= 3; ++g) {
      const IntBox box = quantise_box({glm::vec3(-1), glm::vec3(1)}, n, g);
      const std::int64_t origin = fine_nearest(1.0F, n, g);
      EXPECT_EQ(origin, grid_scale(n) << g);
      EXPECT_EQ(box.max[0], grid_limit(n));
      EXPECT_EQ(box.min[0], -grid_limit(n));
      EXPECT_LT((std::int64_t{box.max[0]} << g) + origin, std::int64_t{1} << (n + g - 1));
    }
  }
}

TEST(QuantiseBoxForAFinerOrigin, ManyBoxesAreEachBoxRounded) {
  Random random(seed + 3);
  int run = 0;
  for (int n = 6; n <= 32; ++n) {
    for (int g = 0; g <= 3; ++g) {
      std::vector<Aabb> boxes(37);
      for (Aabb& box : boxes) {
        box.min = cases::vector_of([&] { return coordinate(random, g); });
        box.max = cases::vector_of([&] { return coordinate(random, g); });
      }
      std::vector<IntBox> rounded(boxes.size());
      quantise_boxes(boxes, n, rounded, g);
      for (std::size_t i = 0; i < boxes.size(); ++i, ++run)
        ASSERT_EQ(rounded[i], quantise_box(boxes[i], n, g)) << "n " << n << " g " << g << ", box " << i;
    }
  }
  EXPECT_EQ(run, 27 * 4 * 37);
}

TEST(QuantiseBoxForAFinerOrigin, CoordinateOutsideTheCubeIsRejected) {
  EXPECT_THROW(static_cast<void>(quantise_box({glm::vec3(0), glm::vec3(1.5F)}, 20, 1)), std::out_of_range);
  EXPECT_THROW(static_cast<void>(quantise_box({glm::vec3(-1.5F), glm::vec3(0)}, 20, 3)), std::out_of_range);
}

}  // namespace
}  // namespace hitpipe::ref::fine_grid_test
