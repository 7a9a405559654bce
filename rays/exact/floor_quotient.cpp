#include "rays/exact/floor_quotient.hpp"

#include <bit>
#include <cstdint>

#include "rays/exact/quick_numbers.hpp"

namespace hitpipe::ref {

namespace {

constexpr int fraction_bits = 52;
constexpr std::uint64_t hidden_bit = std::uint64_t{1} << fraction_bits;

}  // namespace

double floor_quotient(Uint128 numerator, Uint128 denominator) {
  __extension__ typedef __int128 Int128;
  if (numerator == 0) return 0;
  // Two conversions and a division: off by less than 4 units of its last place, and its exponent by 1 at most.
  const double estimate = static_cast<double>(numerator) / static_cast<double>(denominator);
  const auto bits = std::bit_cast<std::uint64_t>(estimate);
  std::uint64_t mantissa = (bits & (hidden_bit - 1)) | hidden_bit;
  int shift = fraction_bits + 1023 - static_cast<int>(bits >> fraction_bits);
  // What the mantissa leaves of the numerator is less than 5 divisors in size, below 2^125. So all but it may be lost
  // in 2^128: its own bits are right.
  const Uint128 divisor = shift >= 0 ? denominator : denominator << -shift;
  const Uint128 dividend = shift >= 128 ? 0 : numerator << (shift > 0 ? shift : 0);
  auto rest = static_cast<Int128>(dividend - mantissa * divisor);
  const auto one = static_cast<Int128>(divisor);
  for (; rest < 0; rest += one) --mantissa;
  for (; rest >= one; rest -= one) ++mantissa;
  if (mantissa < hidden_bit) {
    mantissa = 2 * mantissa + (2 * rest >= one ? 1 : 0);
    ++shift;
  } else if (mantissa > 2 * hidden_bit) {
    mantissa &= ~std::uint64_t{1};
  }
  return static_cast<double>(mantissa) * power_of_two(-shift);
}

}  // namespace hitpipe::ref
