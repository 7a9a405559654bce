// Words as numbers, rounded to the nearest or outward, and the way into the cube.
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include <boost/multiprecision/cpp_int.hpp>
#include <gtest/gtest.h>

#include "sim/operands/number_file.hpp"
#include "sim/operands/rays_and_boxes.hpp"
#include "tests/message_of.hpp"

namespace hitpipe::sim::number_test {
namespace {

using boost::multiprecision::cpp_rational;

constexpr float infinity = std::numeric_limits<float>::infinity();

TEST(Number, IsDecimalOrHexadecimal) {
  EXPECT_EQ(read_double("-0.25"), -0.25);
  EXPECT_EQ(read_double("+3"), 3.0);
  EXPECT_EQ(read_double(".5e1"), 5.0);
  EXPECT_EQ(read_double("0x1.8p-1"), 0.75);
  EXPECT_EQ(read_double("-0Xap0"), -10.0);
  EXPECT_EQ(read_double("1e400"), std::numeric_limits<double>::infinity());
  EXPECT_EQ(read_double("-1e-400"), 0.0);
}

TEST(Number, OtherWordsRejected) {
  for (const char* const word : {"", "-", "x", "inf", "-inf", "nan", "0x", "0xg", "1x", "1 ", " 1", "--1",
                                 "+-1", "-0x-1p0", "1,5", "1e", "e1", "."})
    EXPECT_EQ(read_double(word), std::nullopt) << word;
}

/// Rounded to a double in between, the number would become a tie and then 1.
TEST(Number, IsRoundedToBinary32Once) {
  EXPECT_EQ(nearest_binary32("1.00000005960464477539062500000000001"), 1.0F + 0x1p-23F);
  EXPECT_EQ(nearest_binary32("1.000000059604644775390625"), 1.0F);
  EXPECT_EQ(nearest_binary32("-1e-60"), 0.0F);
  EXPECT_EQ(nearest_binary32("1e60"), infinity);
}

TEST(Number, IsRoundedToEitherSide) {
  EXPECT_LT(read_double("0.1", Rounding::down), read_double("0.1", Rounding::up));
  EXPECT_EQ(read_double("0.5", Rounding::down), 0.5);
  EXPECT_EQ(read_double("0.5", Rounding::up), 0.5);
  // This is the decimal of the nearest binary32 of 0.1 with its last digits cut off.
  const auto side = [](Rounding to) { return to_binary32(read_double("0.10000000149011611", to), 0.0, to); };
  EXPECT_EQ(side(Rounding::up), 0.1F);
  EXPECT_EQ(side(Rounding::down), std::nextafter(0.1F, 0.0F));
}

TEST(Number, SmallestNumbersAreRoundedOutwardToo) {
  EXPECT_EQ(to_binary32(read_double("1e-400", Rounding::up), 0.0, Rounding::up), 0x1p-149F);
  EXPECT_EQ(to_binary32(read_double("1e-400", Rounding::down), 0.0, Rounding::down), 0.0F);
  EXPECT_EQ(to_binary32(read_double("-1e-400", Rounding::down), 0.0, Rounding::down), -0x1p-149F);
}

/// For random bounds a plane is the nearest binary32 on its side of the exact place.
TEST(Placement, PlanesAreTheNearestOnTheirSide) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  for (int i = 0; i < 20'000; ++i) {
    const double unit = std::ldexp(1.0, static_cast<int>(random() % 60) - 30);
    const double low = (part(random) - 0.5) * 1000 * unit;
    const double side = part(random) * unit;
    const Placement placement(ref::Bounds{{low, low, low}, {low + side, low, low}});
    double own = low + side * part(random);
    if (i % 3 == 0) own = static_cast<float>(own);
    if (i % 5 == 0) own = placement.transform().offset.x;
    // Its place is a last bit of a double beside a binary32, or on it but for the errors of the product.
    if (i % 4 == 1)
      own = static_cast<float>(part(random)) / placement.transform().scale + placement.transform().offset.x;
    const cpp_rational place = (cpp_rational(own) - cpp_rational(placement.transform().offset.x)) *
                               cpp_rational(placement.transform().scale);
    const float lower = placement.plane(own, 0, Rounding::down);
    const float upper = placement.plane(own, 0, Rounding::up);
    ASSERT_LE(cpp_rational(lower), place);
    ASSERT_GE(cpp_rational(upper), place);
    ASSERT_GT(cpp_rational(std::nextafter(lower, infinity)), place);
    ASSERT_LT(cpp_rational(std::nextafter(upper, -infinity)), place);
  }
}

TEST(Placement, BoundsReachAlmostToTheFacesOfTheCube) {
  const Placement placement(ref::Bounds{{-10, 0, 2}, {10, 4, 8}});
  EXPECT_EQ(placement.place(-10, 0), -1 + 0x1p-10);
  EXPECT_EQ(placement.place(10, 0), 1 - 0x1p-10);
  EXPECT_EQ(placement.place(2, 1), 0.0);
  EXPECT_EQ(placement.place(5, 2), 0.0);
  EXPECT_EQ(placement.length(3.0), 3 * placement.transform().scale);
}

TEST(Placement, BoundsOfNoUseRejected) {
  const auto told = [](const glm::dvec3& min, const glm::dvec3& max) {
    return message_of<std::runtime_error>([&] { static_cast<void>(Placement(ref::Bounds{min, max})); });
  };
  EXPECT_EQ(told({0, 2, 0}, {1, 1, 1}), "bounds: min_y 2 is above max_y 1");
  EXPECT_EQ(told({1, 1, 1}, {1, 1, 1}), "bounds: the longest side is 0; it must be at least 1e-30");
  EXPECT_EQ(told({0, 0, 0}, {1, 1e31, 1}), "bounds: 1e+31 is out of range; allowed is -1e30 to 1e30");
  EXPECT_EQ(told({0, 0, 0}, {1, std::nan(""), 1}), "bounds: nan is out of range; allowed is -1e30 to 1e30");
}

}  // namespace
}  // namespace hitpipe::sim::number_test
