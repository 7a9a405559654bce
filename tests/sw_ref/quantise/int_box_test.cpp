// Quantised boxes against rational arithmetic, for every n.
#include "sw_ref/quantise/int_box.hpp"

#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "sw_ref/quantise/grid.hpp"
#include "tests/message_of.hpp"
#include "tests/sw_ref/judge/box_cases.hpp"
#include "tests/sw_ref/judge/rational.hpp"

namespace hitpipe::ref::int_box_test {
namespace {

using cases::Random;
using oracle::exact;
using oracle::Rational;

constexpr std::uint64_t seed = 20053;
constexpr float smallest = 0x1p-149F;

const Rational half = Rational(1) / 2;

/// Corner coordinates: zeros, subnormals, powers of two and neighbours, the border of the cube.
float coordinate(Random& random) {
  switch (random.below(6)) {
    case 0:
      return std::array{0.0F, -0.0F, smallest, -smallest, 0x1p-126F, 0x1.fffffcp-127F}[random.below(6)];
    case 1:
      return random.sign() * cases::nudged(std::ldexp(1.0F, -random.between(0, 149)), -random.between(0, 1));
    case 2:
      return random.sign() * (cases::scene_limit + (random.coin() ? cases::padding : 0.0F));
    case 3:
      return random.sign() * std::ldexp(1.5F + 0.5F * random.signed_unit(), -random.between(1, 149));
    case 4:
      return random.sign() * cases::nudged(1.0F, -random.between(0, 2));
    default:
      return random.signed_unit();
  }
}

TEST(QuantiseBox, IsTheOutwardRoundedRationalForEveryWidth) {
  std::printf("seed %llu\n", static_cast<unsigned long long>(seed));
  Random random(seed);
  int run = 0;
  for (int n = 6; n <= 32; ++n) {
    const Rational scale = (std::int64_t{1} << (n - 2)) - 1;
    for (int i = 0; i < 1'500; ++i) {
      Aabb box;
      box.min = cases::vector_of([&] { return coordinate(random); });
      box.max = cases::vector_of([&] { return coordinate(random); });
      const IntBox result = quantise_box(box, n);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const float low = cases::at(box.min, axis);
        const float high = cases::at(box.max, axis);
        ASSERT_EQ(result.min[axis], oracle::floor(scale * exact(low) - half))
            << fmt::format("{:a} n = {}", low, n);
        ASSERT_EQ(result.max[axis], oracle::ceil(scale * exact(high) + half))
            << fmt::format("{:a} n = {}", high, n);
        ASSERT_LE(std::abs(std::int64_t{result.min[axis]}), grid_limit(n));
        ASSERT_LE(std::abs(std::int64_t{result.max[axis]}), grid_limit(n));
        ++run;
      }
    }
  }
  EXPECT_EQ(run, 27 * 1'500 * 3);
}

TEST(QuantiseBox, TinyCoordinatesGrowToOneUnit) {
  for (const int n : {6, 16, 32}) {
    for (const float x : {0.0F, -0.0F, smallest, -smallest, 0x1p-126F, -0x1p-60F}) {
      const IntBox box = quantise_box({glm::vec3(x), glm::vec3(x)}, n);
      EXPECT_EQ(box.min[0], -1) << n << " " << x;
      EXPECT_EQ(box.max[0], 1) << n << " " << x;
    }
  }
}

TEST(QuantiseBox, HalfUnitThatEndsOnTheGridIsNotGrownFurther) {
  // n = 6, G = 15: 15 * 0.5 = 7.5 grows to 7 and 8 exactly.
  const IntBox box = quantise_box({glm::vec3(0.5F), glm::vec3(0.5F)}, 6);
  EXPECT_EQ(box.min[0], 7);
  EXPECT_EQ(box.max[0], 8);
}

TEST(QuantiseBox, ThesisExampleAt16Bits) {
  const IntBox box = quantise_box({{-1, 0, 0.25F}, {-0.5F, 1, 0.5F}}, 16);
  EXPECT_EQ(box.min, (std::array<std::int32_t, 3>{-16384, -1, 4095}));
  EXPECT_EQ(box.max, (std::array<std::int32_t, 3>{-8191, 16384, 8192}));
}

TEST(QuantiseBox, ProductNotExactInBinary32IsStillRoundedOutward) {
  // At n = 24 and above G * x needs up to 54 bits. Count how often binary32 arithmetic puts the bound inside
  // the box.
  Random random(seed + 1);
  int inside = 0;
  constexpr int count = 20'000;
  for (int i = 0; i < count; ++i) {
    const float x = random.signed_unit();
    const float scaled = 4194303.0F * x;
    const auto naive = static_cast<std::int64_t>(std::ceil(scaled + 0.5F));
    const std::int64_t ours = quantise_box({glm::vec3(x), glm::vec3(x)}, 24).max[0];
    ASSERT_GE(Rational(ours), 4194303 * exact(x) + half);
    inside += Rational(naive) < 4194303 * exact(x) + half ? 1 : 0;
  }
  std::printf("binary32 puts %d of %d upper bounds inside the box\n", inside, count);
  EXPECT_GT(inside, count / 50);
}

TEST(QuantiseBox, DifferenceToAnyOriginInTheCubeFitsTheWidth) {
  for (int n = 6; n <= 32; ++n) {
    const IntBox box = quantise_box({glm::vec3(-1), glm::vec3(1)}, n);
    const std::int64_t origin = grid_floor(1.0F, n, Half::up);
    EXPECT_EQ(origin, grid_scale(n));
    EXPECT_EQ(box.max[0] + origin, (std::int64_t{1} << (n - 1)) - 1);
    EXPECT_EQ(-box.min[0] + origin, (std::int64_t{1} << (n - 1)) - 1);
  }
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
  box.max.x = 1.0F + cases::padding;
  EXPECT_EQ(message_of<std::out_of_range>(box, 24),
            "quantise_box: max.x = 1.0000005 leaves the 24-bit grid; boxes must lie within [-1, 1]");
  box.max.x = cases::scene_limit + cases::padding;
  EXPECT_EQ(message_of<std::out_of_range>(box, 32), "no exception");
}

/// Many boxes at once are rounded by other code, up to 16 boxes at a time.
TEST(QuantiseBoxes, AreEachBoxRoundedForAnyNumberOfThem) {
  std::printf("seed %llu\n", static_cast<unsigned long long>(seed + 2));
  Random random(seed + 2);
  int run = 0;
  for (int n = 6; n <= 32; ++n) {
    for (std::size_t count = 0; count <= 40; ++count) {
      std::vector<Aabb> boxes(count);
      for (Aabb& box : boxes) {
        box.min = cases::vector_of([&] { return coordinate(random); });
        box.max = cases::vector_of([&] { return coordinate(random); });
      }
      std::vector<IntBox> rounded(count);
      quantise_boxes(boxes, n, rounded);
      for (std::size_t i = 0; i < count; ++i, ++run) {
        ASSERT_EQ(rounded[i], quantise_box(boxes[i], n)) << "n " << n << ", box " << i << " of " << count;
      }
    }
  }
  EXPECT_EQ(run, 27 * 820);
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
