// A number as a word with one bit that is 1, and back.
#pragma once

#include "hls/num/bits.hpp"
#include "hls/num/levels.hpp"

namespace hitpipe {
namespace hls {

/// Bit x of 2^width_of(x) bits is 1.
template <class D, class X>
constexpr auto one_hot(const X& x) {
  using Bit = typename D::bit;
  const auto widened = [](const auto& low, const Bit& bit) {
    const auto w = width_of(low);
    return cat(low & spread(bit, w), low & spread(Bit(~bit), w));
  };
  const Bit first = bit_at(x, 0_w);
  return for_each_level(width_of(x) - 1_w, cat(first, Bit(~first)), [&](const auto& low, const auto& level) {
    return widened(low, Bit(bit_at(x, level + 1_w)));
  });
}

/// What is left of a word, and the bits of its number so far.
template <class X, class Number>
struct Halved {
  X rest;
  Number number;
};
template <class X, class Number>
constexpr Halved<X, Number> halved(const X& rest, const Number& number) {
  return {rest, number};
}

/// The place of the only bit of x that is 1, in `bits` bits. x has at most 2^bits of them; without a 1 it is
/// 0.
template <class D, class X, class W>
constexpr auto place_of(const X& x, const W& bits) {
  using Bit = typename D::bit;
  const auto half_of = [](const auto& rest) { return width_of(rest) / 2_w; };
  const auto upper = [&](const auto& rest) { return slice(rest, width_of(rest) - 1_w, half_of(rest)); };
  const auto folded = [&](const auto& rest) { return slice(rest, half_of(rest) - 1_w, 0_w) | upper(rest); };
  const auto all = resize(as_unsigned(x), power_of_two(bits));
  return for_each_level(bits - 1_w, halved(folded(all), Bit(any<D>(upper(all)))),
                        [&](const auto& so_far, const auto& /*level*/) {
                          return halved(folded(so_far.rest),
                                        cat(so_far.number, Bit(any<D>(upper(so_far.rest)))));
                        })
      .number;
}

}  // namespace hls
}  // namespace hitpipe
