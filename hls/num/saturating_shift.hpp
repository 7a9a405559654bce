// A left shift that saturates: x 2^e, or the greatest number of x's sign when that does not fit.
#pragma once

#include "hls/num/bits.hpp"
#include "hls/num/levels.hpp"

namespace hitpipe {
namespace hls {

namespace detail {

/// The or of 2^levels bits.
template <class X, class Levels>
constexpr auto or_of(const X& x, const Levels& levels) {
  return for_each_level(levels, x, [](const auto& bits, const auto& /*level*/) {
    const auto half = width_of(bits) / 2_w;
    return slice(bits, width_of(bits) - 1_w, half) | slice(bits, half - 1_w, 0_w);
  });
}

/// The low bits of x, with `fill` shifted in below them.
template <class X, class W>
constexpr auto shifted_in(const X& fill, const X& x, const W& amount) {
  return cat(slice(x, width_of(x) - 1_w - amount, 0_w), slice(fill, amount - 1_w, 0_w));
}

/// The magnitude after some levels of the shifter.
template <class Word, class Bit>
struct Shifted {
  Word magnitude;
  Bit lost;  ///< a 1 was shifted out
};

/// One level: left by 2^power if bit `power` of e is 1.
template <class Bit, class Word, class E, class W>
constexpr Shifted<Word, Bit> shift_level(const Word& magnitude, const Word& fill, const E& e,
                                         const W& power) {
  const auto bits = width_of(magnitude);
  const auto amount = power_of_two(power);
  const Bit shift = bit_at(e, power);
  const Word moved =
      change_if(amount < bits, fill, [&](const auto& low) { return shifted_in(low, magnitude, amount); });
  const Bit lost = or_of(slice(magnitude, bits - 1_w, bits - amount), power);
  return {select(shift, moved, magnitude), shift & lost};
}

}  // namespace detail

/// x has W bits and is signed; e has count_bits(W) bits and is at most W - 1. A result that does not fit is
/// 2^(W-1) - 1 or -2^(W-1).
template <class D, class X, class E>
constexpr X saturating_shift(const X& x, const E& e) {
  using Bit = typename D::bit;
  // Magnitudes in one's complement: x, or -x - 1 of a negative x. Then every 1 that is shifted out means
  // that the result does not fit, and shifting in the sign makes up for the - 1.
  const auto bits = width_of(x) - 1_w;
  const auto levels = width_of(e);
  using Word = decltype(slice(x, bits - 1_w, 0_w));
  const Word fill = spread(sign(x), bits);
  const Word magnitude = slice(x, bits - 1_w, 0_w) ^ fill;

  const auto shifted = for_each_level(
      levels - 1_w, detail::shift_level<Bit>(magnitude, fill, e, levels - 1_w),
      [&](const auto& from, const auto& level) {
        const auto to = detail::shift_level<Bit>(from.magnitude, fill, e, levels - 2_w - level);
        return detail::Shifted<Word, Bit>{to.magnitude, from.lost | to.lost};
      });
  return as_signed(cat(sign(x), (shifted.magnitude | spread(shifted.lost, bits)) ^ fill));
}

}  // namespace hls
}  // namespace hitpipe
