// Boxes and origins on the grids of every n and g, against rational arithmetic.
#include "rays/world/int_box.hpp"

#include <array>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "rays/exact/grid.hpp"
#include "sw_ref/judge/adversary/parts.hpp"
#include "tests/message_of.hpp"
#include "tests/rays/exact/rational.hpp"

namespace hitpipe::ref::int_box_test {
namespace {

using adversary::nudged;
using adversary::Random;
using oracle::exact;
using oracle::Rational;

constexpr std::uint64_t seed = 20053;
constexpr float smallest = 0x1p-149F;

const Rational half = Rational(1) / 2;

/// Calls check(n, g) for every width and finer grid.
template <class Check>
void each_grid(int narrowest, const Check& check) {
  for (int n = narrowest; n <= 32; ++n) {
    for (int g = 0; g <= 3; ++g) {
      check(n, g);
      if (testing::Test::HasFailure()) FAIL() << "n " << n << " g " << g;
    }
  }
}

/// Ties of the fine grid and their neighbours, powers of two down to subnormals, zeros, the border of the
/// cube and of a padded scene, any number.
float coordinate(Random& random, int finer) {
  switch (random.below(8)) {
    case 0: {
      const int odd = 2 * random.between(0, (1 << finer) - 1) + 1;
      const float tie = std::ldexp(static_cast<float>(odd), -(finer + 1));
      return random.sign() * nudged(tie, random.coin() ? 0 : random.between(-1, 1));
    }
    case 1:
      return random.sign() * nudged(std::ldexp(1.0F, -random.between(0, 149)), -random.between(0, 1));
    case 2:
      return random.sign() * nudged(1.0F, -random.between(0, 2));
    case 3:
      return random.signed_zero();
    case 4:
      return random.of_exponent(-40, -1);
    case 5:
      return random.sign() * std::array{smallest, 0x1p-126F, 0x1.fffffcp-127F}[random.below(3)];
    case 6:
      return random.sign() * (1.0F - 0x1p-10F + (random.coin() ? 5e-7F : 0.0F));
    default:
      return random.signed_unit();
  }
}

/// Its min may be above its max.
Aabb any_box(Random& random, int finer) {
  const auto any = [&] { return coordinate(random, finer); };
  return {adversary::vector_of(any), adversary::vector_of(any)};
}

TEST(FineGrid, RoundsAsRationals) {
  Random random(seed);
  each_grid(4, [&](int n, int g) {
    for (int i = 0; i < 600; ++i) {
      const float x = (random.below(8) == 0 ? 2.0F : 1.0F) * coordinate(random, g);
      const Rational fine = grid_scale(n) * exact(x) * (1 << g);
      ASSERT_EQ(fine_nearest(x, n, g), oracle::floor(fine + half)) << fmt::format("{:a}", x);
      ASSERT_EQ(fine_lower(x, n, g), oracle::floor((fine - half) / (1 << g))) << fmt::format("{:a}", x);
    }
  });
}

TEST(QuantiseBox, IsTheOutwardRoundedRational) {
  Random random(seed + 1);
  each_grid(6, [&](int n, int g) {
    const Rational half_unit = Rational(1) / (2 << g);
    for (int i = 0; i < 400; ++i) {
      const Aabb box = any_box(random, g);
      const IntBox result = quantise_box(box, n, g);
      for (int axis = 0; axis < 3; ++axis) {
        const auto at = static_cast<std::size_t>(axis);
        const Rational low = grid_scale(n) * exact(box.min[axis]);
        const Rational high = grid_scale(n) * exact(box.max[axis]);
        ASSERT_EQ(result.min[at], oracle::floor(low - half_unit)) << fmt::format("{:a}", box.min[axis]);
        ASSERT_EQ(result.max[at], oracle::ceil(high + half_unit)) << fmt::format("{:a}", box.max[axis]);
        ASSERT_LE(std::abs(std::int64_t{result.min[at]}), grid_limit(n));
        ASSERT_LE(std::abs(std::int64_t{result.max[at]}), grid_limit(n));
      }
    }
  });
}

TEST(QuantiseBox, ThesisExampleAt16Bits) {
  const IntBox box = quantise_box({{-1, 0, 0.25F}, {-0.5F, 1, 0.5F}}, 16);
  EXPECT_EQ(box.min, (std::array<std::int32_t, 3>{-16384, -1, 4095}));
  EXPECT_EQ(box.max, (std::array<std::int32_t, 3>{-8191, 16384, 8192}));
}

/// 15/2 = 7.5, 15/4 = 3.75, 15/8 = 1.875 and 15/16 = 0.9375 (n = 6, G = 15): each ends on the grid with one
/// margin. The margin keeps a box around what a rounded origin sees, so it shrinks with the origin's error.
TEST(QuantiseBox, GrowsByHalfAUnitOfTheOriginsGrid) {
  const auto upper = [](float x) {
    std::array<int, 4> by_g{};
    for (int g = 0; g <= 3; ++g)
      by_g[static_cast<std::size_t>(g)] = quantise_box({glm::vec3(x), glm::vec3(x)}, 6, g).max[0];
    return by_g;
  };
  EXPECT_EQ(upper(0.5F), (std::array{8, 8, 8, 8}));
  EXPECT_EQ(upper(0.25F), (std::array{5, 4, 4, 4}));
  EXPECT_EQ(upper(0.125F), (std::array{3, 3, 2, 2}));
  EXPECT_EQ(upper(0.0625F), (std::array{2, 2, 2, 1}));
}

TEST(QuantiseBox, DifferenceToAnyOriginInTheCubeFitsTheWidth) {
  each_grid(6, [](int n, int g) {
    const IntBox box = quantise_box({glm::vec3(-1), glm::vec3(1)}, n, g);
    const std::int64_t origin = fine_nearest(1.0F, n, g);
    EXPECT_EQ(origin, grid_scale(n) << g);
    EXPECT_EQ(box.max[0], grid_limit(n));
    EXPECT_EQ(box.min[0], -grid_limit(n));
    EXPECT_LT((std::int64_t{box.max[0]} << g) + origin, std::int64_t{1} << (n + g - 1));
  });
}

template <class Error>
std::string message_of(const Aabb& box, int n) {
  return hitpipe::message_of<Error>([&] { static_cast<void>(quantise_box(box, n)); });
}

TEST(QuantiseBox, CoordinateOutsideTheCubeIsRejected) {
  const Aabb good{glm::vec3(-1), glm::vec3(1)};
  Aabb box = good;
  box.max.y = 1.5F;
  EXPECT_EQ(message_of<std::out_of_range>(box, 16),
            "quantise_box: max.y = 1.5 leaves the 16-bit grid; boxes must lie within [-1, 1]");
  box = good;
  box.min.z = -3e38F;
  EXPECT_EQ(message_of<std::out_of_range>(box, 6),
            "quantise_box: min.z = -3e+38 leaves the 6-bit grid; boxes must lie within [-1, 1]");
  box.min.z = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(message_of<std::out_of_range>(box, 32),
            "quantise_box: min.z = nan leaves the 32-bit grid; boxes must lie within [-1, 1]");
  // A padded box on the very border would overflow from n = 24 on. The margin of 2^-10 prevents that.
  box = good;
  box.max.x = 1.0F + 5e-7F;
  EXPECT_EQ(message_of<std::out_of_range>(box, 24),
            "quantise_box: max.x = 1.0000005 leaves the 24-bit grid; boxes must lie within [-1, 1]");
  box.max.x = 1.0F - 0x1p-10F + 5e-7F;
  EXPECT_EQ(message_of<std::out_of_range>(box, 32), "no exception");
}

/// Many boxes at once are rounded by other code, up to 16 boxes at a time.
TEST(QuantiseBoxes, AreEachBoxRoundedForAnyNumberOfThem) {
  Random random(seed + 2);
  each_grid(6, [&](int n, int g) {
    for (std::size_t count = 0; count <= 40; ++count) {
      std::vector<Aabb> boxes(count);
      for (Aabb& box : boxes) box = any_box(random, g);
      std::vector<IntBox> rounded(count);
      quantise_boxes(boxes, n, rounded, g);
      for (std::size_t i = 0; i < count; ++i)
        ASSERT_EQ(rounded[i], quantise_box(boxes[i], n, g)) << "box " << i << " of " << count;
    }
  });
}

TEST(QuantiseBoxes, OneOutsideTheCubeIsRejected) {
  for (const float outside : {1.5F, -3e38F, std::numeric_limits<float>::quiet_NaN()}) {
    for (std::size_t at = 0; at < 20; ++at) {
      std::vector<Aabb> boxes(20, {glm::vec3(-1), glm::vec3(1)});
      std::vector<IntBox> rounded(boxes.size());
      EXPECT_NO_THROW(quantise_boxes(boxes, 24, rounded));
      boxes[at].min.y = outside;
      EXPECT_THROW(quantise_boxes(boxes, 24, rounded), std::out_of_range) << at;
    }
  }
}

TEST(QuantiseBox, WidthOutsideTheFormatIsRejected) {
  const Aabb box{glm::vec3(0), glm::vec3(0)};
  EXPECT_EQ(message_of<std::invalid_argument>(box, 5),
            "quantise_box: 5 coordinate bits; allowed are 6 to 32");
  EXPECT_EQ(message_of<std::invalid_argument>(box, 33),
            "quantise_box: 33 coordinate bits; allowed are 6 to 32");
}

}  // namespace
}  // namespace hitpipe::ref::int_box_test
