// The native value domain: hls/num's own integers, on the host. A pipeline is a template over a domain D. It
// names D::sint<W>, D::uint<W> and D::bit, stores each comparison into a bit at once, combines bits with
// & | ^ ~ only, and selects with select(). The vocabulary is described in hls/num/bits.hpp.
#pragma once

#include <concepts>
#include <cstdint>

#include "hls/num/ap_int.hpp"
#include "hls/num/bits.hpp"

namespace hitpipe::hls {

struct Native {
  template <int W>
  using sint = ap_int<W>;
  template <int W>
  using uint = ap_uint<W>;
  using bit = ap_uint<1>;

  template <int W>
  static constexpr ap_uint<W> lit(std::int64_t value, Width<W> /*width*/) {
    return value;
  }
};

template <int W, bool S>
constexpr Width<W> width_of(const ap_base<W, S>& /*x*/) {
  return {};
}

template <int Hi, int Lo, int W, bool S>
requires(W > Hi && Hi >= Lo && Lo >= 0)  //
    constexpr ap_uint<Hi - Lo + 1> slice(const ap_base<W, S>& x, Width<Hi> /*high*/, Width<Lo> /*low*/) {
  using Part = ap_uint<Hi - Lo + 1>;
  return Part::wrapped(words::convert<typename Part::word_type, false>(words::shift_right<S>(x.word(), Lo)));
}

template <int Wa, bool Sa, int Wb, bool Sb>
constexpr ap_uint<Wa + Wb> cat(const ap_base<Wa, Sa>& a, const ap_base<Wb, Sb>& b) {
  return ap_uint<Wa + Wb>(ap_uint<Wa>(a)) << Wb | ap_uint<Wb>(b);
}

/// `bit` must be a Bit, not a bool or a wider word; a and b have one type.
template <std::same_as<Native::bit> Bit, int W, bool S>
constexpr ap_base<W, S> select(const Bit& bit, const ap_base<W, S>& a, const ap_base<W, S>& b) {
  return bit.word() != 0 ? a : b;
}

template <int W, int Wx, bool S>
constexpr ap_base<W, S> resize(const ap_base<Wx, S>& x, Width<W> /*width*/) {
  return x;
}

template <int W, bool S>
constexpr ap_int<W> as_signed(const ap_base<W, S>& x) {
  return x;
}
template <int W, bool S>
constexpr ap_uint<W> as_unsigned(const ap_base<W, S>& x) {
  return x;
}

template <int W, bool S>
constexpr ap_base<W, S> as(const char* /*name*/, const ap_base<W, S>& x) {
  return x;
}
template <int W, bool S>
constexpr ap_base<W, S> as(const char* /*name*/, char /*axis*/, const ap_base<W, S>& x) {
  return x;
}

}  // namespace hitpipe::hls
