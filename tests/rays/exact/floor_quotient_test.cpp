// A floor of a quotient, against integers of any size.
#include "rays/exact/floor_quotient.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "tests/rays/exact/rational.hpp"

namespace hitpipe::ref::floor_quotient_test {
namespace {

oracle::Integer wide(Uint128 x) {
  return (oracle::Integer(static_cast<std::uint64_t>(x >> 64U)) << 64U) + static_cast<std::uint64_t>(x);
}

/// Of up to so many bits: random ones, few ones, or nearly all ones.
Uint128 number(std::mt19937_64& random, unsigned most_bits) {
  const Uint128 full = (static_cast<Uint128>(random()) << 64U) | random();
  const auto bits = static_cast<unsigned>(1 + random() % most_bits);
  const Uint128 below = (static_cast<Uint128>(1) << bits) - 1;
  switch (random() % 4) {
    case 0:
      return below - (full & 7U & below);
    case 1:
      return ((below >> 1U) + 1) | (full & 3U & below);
    default:
      return full & below;
  }
}

TEST(FloorQuotient, IsTheNextDoubleBelow) {
  std::mt19937_64 random(41);
  int exact = 0;
  for (int i = 0; i < 300'000; ++i) {
    const Uint128 denominator = number(random, 122) | 1U;
    Uint128 numerator = number(random, 124);
    // A product, or one beside it.
    if (i % 3 == 0) {
      const Uint128 whole = number(random, 54);
      if (denominator >> 60U == 0) numerator = denominator * whole + random() % 3;
      if (numerator > 1 && i % 2 == 0) --numerator;
    }
    const double found = floor_quotient(numerator, denominator);
    const oracle::Rational right(wide(numerator), wide(denominator));
    ASSERT_LE(oracle::exact(found), right) << i;
    const double next = numerator == 0 ? 1 : std::nextafter(found, std::numeric_limits<double>::max());
    ASSERT_GT(oracle::exact(next), right) << i;
    exact += oracle::exact(found) == right ? 1 : 0;
  }
  EXPECT_GT(exact, 1'000);
}

TEST(FloorQuotient, EndsOfItsRange) {
  const Uint128 one = 1;
  EXPECT_EQ(floor_quotient(0, 1), 0.0);
  EXPECT_EQ(floor_quotient(1, 3), 0x1.5555555555555p-2);
  EXPECT_EQ(floor_quotient(1, one << 122U), 0x1p-122);
  EXPECT_EQ(floor_quotient((one << 124U) - 1, 1), 0x1.fffffffffffffp123);
  EXPECT_EQ(floor_quotient((one << 54U) - 1, one << 54U), 0x1.fffffffffffffp-1);
}

}  // namespace
}  // namespace hitpipe::ref::floor_quotient_test
