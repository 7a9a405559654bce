// The native value domain, and the free functions that every value domain has (tracing and vendors' types
// have their own, found by argument-dependent lookup). A pipeline is a template over a domain D: it names
// D::sint<W>, D::uint<W> and D::bit, stores each comparison into a bit at once, combines bits with & | ^ ~
// only, and selects with select(). Natively a bit is ap_uint<1>, and naming a value with as() costs nothing.
#pragma once

#include <concepts>

#include "hls/num/ap_int.hpp"

namespace hitpipe::hls {

struct Native {
  template <int W>
  using sint = ap_int<W>;
  template <int W>
  using uint = ap_uint<W>;
  using bit = ap_uint<1>;
};

/// Bits Hi..Lo of x, unsigned, Hi-Lo+1 bits wide.
template <int Hi, int Lo, int W, bool S>
requires(W > Hi && Hi >= Lo && Lo >= 0) constexpr ap_uint<Hi - Lo + 1> slice(const ap_base<W, S>& x) {
  using Part = ap_uint<Hi - Lo + 1>;
  return Part::wrapped(words::convert<typename Part::word_type, false>(words::shift_right<S>(x.word(), Lo)));
}

/// The bits of a above those of b, unsigned, Wa+Wb bits wide.
template <int Wa, bool Sa, int Wb, bool Sb>
constexpr ap_uint<Wa + Wb> cat(const ap_base<Wa, Sa>& a, const ap_base<Wb, Sb>& b) {
  return ap_uint<Wa + Wb>(ap_uint<Wa>(a)) << Wb | ap_uint<Wb>(b);
}

/// A multiplexer: a where the bit is 1, else b. A bit, not a bool or a wider word; a and b of one type.
template <std::same_as<Native::bit> Bit, int W, bool S>
constexpr ap_base<W, S> select(const Bit& bit, const ap_base<W, S>& a, const ap_base<W, S>& b) {
  return bit.word() != 0 ? a : b;
}

/// x in W bits, of the same signedness: extended by its own sign, or its low W bits.
template <int W, int Wx, bool S>
constexpr ap_base<W, S> resize(const ap_base<Wx, S>& x) {
  return x;
}

/// A constant of W bits in domain D; v is wrapped to W bits.
template <int W, class D = Native, std::integral V>
constexpr typename D::template uint<W> lit(V v) {
  return typename D::template uint<W>(v);
}

/// Names a value in a traced graph; natively x itself.
template <int W, bool S>
constexpr ap_base<W, S> as(const char* /*name*/, const ap_base<W, S>& x) {
  return x;
}
/// Names one of three values, axis 'x', 'y' or 'z'; natively x itself.
template <int W, bool S>
constexpr ap_base<W, S> as(const char* /*name*/, char /*axis*/, const ap_base<W, S>& x) {
  return x;
}

}  // namespace hitpipe::hls
