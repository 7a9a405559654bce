// Building blocks of the float operators: shifters and a leading-zero count whose amounts are data. Each is
// log2 levels of multiplexers, so that it can be cut into pipeline stages at any level.
#pragma once

#include "hls/num/domain.hpp"

namespace hitpipe::hls::fp_logic {

template <class D, int W>
using Word = typename D::template uint<W>;

/// The bits that count 0 .. values-1.
constexpr int count_bits(int values) {
  int bits = 0;
  while ((1 << bits) < values) ++bits;
  return bits;
}

/// W copies of a bit.
template <class D, int W>
constexpr Word<D, W> spread(const typename D::bit& bit) {
  return Word<D, W>(typename D::template sint<1>(bit));
}

template <class D, int W>
constexpr typename D::bit any(const Word<D, W>& x) {
  return typename D::bit(x != hls::lit<W, D>(0));
}

/// x times 2^(2^S - 1 - amount), exactly: shifts right without losing a bit. A level doubles the bits gained.
template <class D, int W, int S, int Level = 0>
constexpr Word<D, W + (1 << S) - (1 << Level)> shift_right(const Word<D, W>& x, const Word<D, S>& amount) {
  if constexpr (Level == S) {
    return x;
  } else {
    constexpr int by = 1 << Level;
    const auto zeros = hls::lit<by, D>(0);
    const Word<D, W + by> shifted = select(slice<Level, Level>(amount), cat(zeros, x), cat(x, zeros));
    return shift_right<D, W + by, S, Level + 1>(shifted, amount);
  }
}

/// x times 2^amount, modulo 2^W; 2^(S-1) < W.
template <class D, int W, int S, int Level = S - 1>
constexpr Word<D, W> shift_left(const Word<D, W>& x, const Word<D, S>& amount) {
  if constexpr (Level < 0) {
    return x;
  } else {
    constexpr int by = 1 << Level;
    const Word<D, W> moved = cat(slice<W - 1 - by, 0>(x), hls::lit<by, D>(0));
    const Word<D, W> shifted = select(slice<Level, Level>(amount), moved, x);
    return shift_left<D, W, S, Level - 1>(shifted, amount);
  }
}

/// Each bit or'd with all above it: below the leading one all bits are 1.
template <class D, int W, int By = 1>
constexpr Word<D, W> smear(const Word<D, W>& x) {
  if constexpr (By >= W) {
    return x;
  } else {
    const Word<D, W> above = cat(hls::lit<By, D>(0), slice<W - 1, By>(x));
    return smear<D, W, 2 * By>(Word<D, W>(x | above));
  }
}

/// How many ones a word of ones above zeros has: a binary search, a multiplexer a step.
template <class D, int S>
constexpr Word<D, S> count_ones_above(const Word<D, (1 << S) - 1>& ones) {
  if constexpr (S == 1) {
    return ones;
  } else {
    constexpr int half = 1 << (S - 1);
    const typename D::bit many = slice<half - 1, half - 1>(ones);
    const Word<D, half - 1> rest = select(many, slice<half - 2, 0>(ones), slice<2 * half - 2, half>(ones));
    return cat(many, count_ones_above<D, S - 1>(rest));
  }
}

/// Zeros above the leading one; W - 1 when only the lowest bit is set, or none is.
template <class D, int W>
constexpr Word<D, count_bits(W)> leading_zeros(const Word<D, W>& x) {
  constexpr int count_width = count_bits(W);
  constexpr int all = (1 << count_width) - 1;
  const Word<D, W - 1> upper = slice<W - 1, 1>(x);
  const Word<D, W - 1> zeros(~smear<D, W - 1>(upper));
  if constexpr (all == W - 1) {
    return count_ones_above<D, count_width>(zeros);
  } else {
    return count_ones_above<D, count_width>(cat(zeros, hls::lit<all - (W - 1), D>(0)));
  }
}

}  // namespace hitpipe::hls::fp_logic
