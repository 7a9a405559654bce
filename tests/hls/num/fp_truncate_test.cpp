// The float operators that round toward zero against exact integers: all pairs of small formats, natively and
// with widths known at run time, and binary32 against doubles.
#include "hls/num/fp_truncate.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <random>

#include <gtest/gtest.h>

#include "hls/box/fp_format.hpp"
#include "hls/num/domain.hpp"
#include "hls/num/sized.hpp"
#include "tests/hls/num/exact_float.hpp"

namespace hitpipe::hls {
namespace {

using exact::FloatFormat;
using exact::Integer;

/// The pattern of a magnitude in smallest subnormal numbers, cut to M fraction bits. Field 0 is the binade of
/// 2^-bias, and the place of all below.
std::uint64_t pattern_of(const FloatFormat& format, const Integer& units) {
  if (units == 0) return 0;
  const int m = format.fraction_bits;
  int top = 0;
  while (exact::power_of_two(top + 1) <= units) ++top;
  const Integer significand =
      top < m ? Integer(units * exact::power_of_two(m - top)) : Integer(units / exact::power_of_two(top - m));
  const int field = std::max(0, top - m + 1);
  return (static_cast<std::uint64_t>(field) << m) +
         static_cast<std::uint64_t>(Integer(significand - exact::power_of_two(m)));
}

int exponent_of(const FloatFormat& format, std::uint64_t x) {
  return std::max(1, static_cast<int>(format.magnitude(x) >> format.fraction_bits));
}

/// Half a unit of the larger term's last place is borrowed where bits of the smaller one may be lost.
std::uint64_t cut_difference(const FloatFormat& format, std::uint64_t a, std::uint64_t b) {
  const Integer difference = format.signed_units(a) - format.signed_units(b);
  const bool negative_zero = format.is_zero(a) && format.is_negative(a) && !format.is_negative(b);
  if (difference < 0 || (difference == 0 && negative_zero)) return format.sign();
  const int low = std::min(exponent_of(format, a), exponent_of(format, b));
  const int high = std::max(exponent_of(format, a), exponent_of(format, b));
  if (high - low < 2 || format.is_negative(a) != format.is_negative(b)) return pattern_of(format, difference);
  const Integer half = exact::power_of_two(high - 2);
  const Integer first = std::max(format.units(format.magnitude(a)), format.units(format.magnitude(b)));
  const Integer second = first - difference;
  return pattern_of(format, first - (second / half + 1) * half);
}

/// What the proof of fp_slabs_safe relies on.
void expect_bounds(const FloatFormat& format, const Integer& difference, std::uint64_t result) {
  const std::uint64_t least_normal = std::uint64_t{1} << format.fraction_bits;
  if (difference == 0) {
    ASSERT_EQ(format.magnitude(result), 0U);
  } else if (result < least_normal) {
    // As the multiplier reads it: (1 + fraction) 2^-bias.
    ASSERT_GE(Integer(least_normal + result), 2 * difference);
  } else {
    ASSERT_LE(format.units(result), difference);
    ASSERT_GE(format.units(result + 1), difference);
  }
}

/// By counting patterns up: each is (2^M + fraction) 2^field, and so is a product times 2^(M + bias).
std::uint64_t cut_product(const FloatFormat& format, std::uint64_t a, std::uint64_t b) {
  const int m = format.fraction_bits;
  const int bias = (1 << (format.exponent_bits - 1)) - 1;
  const std::uint64_t most = (std::uint64_t{1} << (format.exponent_bits + m)) - 1;
  if (b >= format.infinity()) return most;
  const auto scaled = [&](std::uint64_t x) -> Integer {
    const std::uint64_t implicit = std::uint64_t{1} << m;
    return Integer((implicit + x % implicit) * exact::power_of_two(static_cast<int>(x >> m)));
  };
  const Integer product = scaled(a) * scaled(b);
  std::uint64_t pattern = 0;
  while (pattern < most && scaled(pattern + 1) * exact::power_of_two(m + bias) <= product) ++pattern;
  return pattern;
}

template <int E, int M>
void expect_every_difference() {
  const FloatFormat reference{E, M};
  using Pattern = ap_uint<1 + E + M>;
  for (std::uint64_t a = 0; a < 2 * reference.sign(); ++a) {
    for (std::uint64_t b = 0; b < 2 * reference.sign(); ++b) {
      if (reference.magnitude(a) >= reference.infinity() || reference.magnitude(b) >= reference.infinity())
        continue;
      const Integer difference = reference.signed_units(a) - reference.signed_units(b);
      if (difference >= reference.units(reference.infinity()) ||
          -difference >= reference.units(reference.infinity()))
        continue;
      const std::uint64_t right = cut_difference(reference, a, b);
      const std::uint64_t meant = difference < 0 ? reference.sign() : ~std::uint64_t{0};
      const auto native = fp_logic::subtract_rz<Native>(
          FpFormat<E, M>(), Pattern(static_cast<std::int64_t>(a)), Pattern(static_cast<std::int64_t>(b)));
      ASSERT_EQ(native.word() & meant, right) << std::hex << a << " - " << b;
      const auto sized =
          fp_logic::subtract_rz<Sized>(FpBits{E, M}, Sized::uint(a, 1 + E + M), Sized::uint(b, 1 + E + M));
      ASSERT_EQ(sized.word() & meant, right) << std::hex << a << " - " << b;
      if (difference >= 0) expect_bounds(reference, difference, right);
    }
  }
}

template <int E, int M>
void expect_every_product() {
  const FloatFormat reference{E, M};
  using Pattern = ap_uint<E + M>;
  const std::uint64_t one = static_cast<std::uint64_t>((1 << (E - 1)) - 1) << M;
  for (std::uint64_t a = 0; a < reference.infinity(); ++a) {
    for (std::uint64_t b = one; b <= reference.infinity(); ++b) {
      const std::uint64_t right = cut_product(reference, a, b);
      const auto native = fp_logic::multiply_rz<Native>(
          FpFormat<E, M>(), Pattern(static_cast<std::int64_t>(a)), Pattern(static_cast<std::int64_t>(b)));
      ASSERT_EQ(native.word(), right) << std::hex << a << " * " << b;
      const auto sized =
          fp_logic::multiply_rz<Sized>(FpBits{E, M}, Sized::uint(a, E + M), Sized::uint(b, E + M));
      ASSERT_EQ(sized.word(), right) << std::hex << a << " * " << b;
    }
  }
}

TEST(TruncatedDifference, BorrowsHalfAUnitForLostBitsInSmallFormats) {
  expect_every_difference<2, 1>();
  expect_every_difference<2, 4>();
  expect_every_difference<3, 2>();
  expect_every_difference<4, 1>();
  expect_every_difference<4, 3>();
  expect_every_difference<5, 2>();
  expect_every_difference<2, 7>();
}

TEST(TruncatedProduct, IsExactlyCutInSmallFormats) {
  expect_every_product<2, 1>();
  expect_every_product<2, 4>();
  expect_every_product<3, 2>();
  expect_every_product<3, 4>();
  expect_every_product<4, 3>();
}

/// Toward zero: the nearest binary32, or the one before it.
float cut_to_float(double x) {
  const auto nearest = static_cast<float>(x);
  return std::abs(static_cast<double>(nearest)) > std::abs(x) ? std::nextafter(nearest, 0.0F) : nearest;
}

TEST(TruncatedOperators, AreWithinAUnitOfDoublesInBinary32) {
  std::mt19937 engine(1);
  // Exponents within 29 of each other: then a double holds the difference, and always the product.
  const auto number = [&] {
    const auto exponent = 110U + static_cast<std::uint32_t>(engine() % 29U);
    return std::bit_cast<float>((static_cast<std::uint32_t>(engine()) & 0x807FFFFFU) | exponent << 23U);
  };
  for (int i = 0; i < 200'000; ++i) {
    const float a = number();
    const float b = i % 3 == 0 ? std::nextafter(a, number()) : number();
    const auto pattern = [](float x) {
      return ap_uint<32>(static_cast<std::int64_t>(std::bit_cast<std::uint32_t>(x)));
    };
    const auto difference = fp_logic::subtract_rz<Native>(Fp32(), pattern(a), pattern(b));
    if (a < b) {
      ASSERT_EQ(sign(difference).word(), 1U) << a << " - " << b;
    } else {
      const auto found = std::bit_cast<float>(static_cast<std::uint32_t>(difference.word()));
      const double exact = static_cast<double>(a) - b;
      ASSERT_LE(found, exact) << a << " - " << b;
      ASSERT_GE(std::nextafter(found, HUGE_VALF), exact) << a << " - " << b;
    }
    const float large = std::max(1.0F, std::abs(b));
    const auto product =
        fp_logic::multiply_rz<Native>(Fp32(), ap_uint<31>(pattern(std::abs(a))), ap_uint<31>(pattern(large)));
    ASSERT_EQ(product.word(), pattern(cut_to_float(static_cast<double>(std::abs(a)) * large)).word())
        << a << " * " << large;
  }
}

}  // namespace
}  // namespace hitpipe::hls
