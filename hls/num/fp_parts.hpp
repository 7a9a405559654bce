// Building blocks of the float operators: shifters and a leading-zero count. Shift amounts are data. Each
// block is log2 levels of multiplexers, so pipeline stages can cut it at any level.
#pragma once

#include "hls/num/bits.hpp"
#include "hls/num/levels.hpp"

namespace hitpipe {
namespace hls {
namespace fp_logic {

/// x times 2^(2^s - 1 - amount), exactly, for an amount of s bits: shifts right without losing a bit. Each
/// level adds 1, 2, 4, ... bits.
template <class D, class X, class Amount>
constexpr auto shift_right(const X& x, const Amount& amount) {
  return for_each_level(width_of(amount), x, [&](const auto& so_far, const auto& level) {
    const auto zeros = D::lit(0, power_of_two(level));
    return select(bit_at(amount, level), cat(zeros, so_far), cat(so_far, zeros));
  });
}

/// x times 2^amount for an amount of s bits, modulo 2^w; 2^(s-1) < w, the width of x.
template <class D, class X, class Amount>
constexpr X shift_left(const X& x, const Amount& amount) {
  const auto last = width_of(amount) - 1_w;
  return for_each_level(width_of(amount), x, [&](const auto& so_far, const auto& level) {
    const auto by = power_of_two(last - level);
    const auto moved = cat(slice(so_far, width_of(x) - 1_w - by, 0_w), D::lit(0, by));
    return select(bit_at(amount, last - level), moved, so_far);
  });
}

/// ORs each bit with all bits above it: from the leading one down all bits are 1.
template <class D, class X>
constexpr X smear(const X& x) {
  return for_each_level(count_bits(width_of(x)), x, [&](const auto& so_far, const auto& level) {
    const auto by = power_of_two(level);
    return so_far | cat(D::lit(0, by), slice(so_far, width_of(x) - 1_w, by));
  });
}

/// Counts the 1 bits of a word in which they are all on top, in s bits for a word of 2^s - 1 bits. It is a
/// binary search with one multiplexer for each step.
template <class D, class S, class Ones>
constexpr Word<D, S> count_ones_above(const S& s, const Ones& ones) {
  return change_if(1_w < s, ones, [&](const auto& word) {
    const auto half = power_of_two(s - 1_w);
    const auto many = bit_at(word, half - 1_w);
    const auto rest = select(many, slice(word, half - 2_w, 0_w), slice(word, half + half - 2_w, half));
    return cat(many, count_ones_above<D>(s - 1_w, rest));
  });
}

/// Zeros above the leading one. The result is w - 1 when only the lowest bit or no bit is set; w is the width
/// of x.
template <class D, class X>
constexpr auto leading_zeros(const X& x) {
  const auto w = width_of(x);
  const auto count_width = count_bits(w);
  const auto counted = power_of_two(count_width) - 1_w;
  const Word<D, decltype(w - 1_w)> zeros = ~smear<D>(slice(x, w - 1_w, 1_w));
  const auto filled = change_if(w - 1_w < counted, zeros, [&](const auto& upper) {
    return cat(upper, D::lit(0, counted - width_of(upper)));
  });
  return count_ones_above<D>(count_width, filled);
}

}  // namespace fp_logic
}  // namespace hls
}  // namespace hitpipe
