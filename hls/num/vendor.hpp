// The value domain of a vendor's ap_int: the pipelines compiled against the headers that a user's HLS tool
// brings. <ap_int.h> comes from the user's folder (CMake HITPIPE_VENDOR_AP_INT); only its documented ap_int
// and ap_uint are used. The free functions below are global, beside the vendor's types, so that a pipeline's
// calls find them there. They return plain ap_uint or ap_int: a vendor's range() is a proxy that counts as
// wide as its parent, and its comma is not a concatenation of two bools.
#pragma once

#include <concepts>

#include <ap_int.h>

namespace hitpipe::hls {

struct Vendor {
  template <int W>
  using sint = ::ap_int<W>;
  template <int W>
  using uint = ::ap_uint<W>;
  using bit = ::ap_uint<1>;
};

/// Width and signedness of a vendor's integer.
template <class T>
struct VendorShape;
template <int W>
struct VendorShape<::ap_int<W>> {
  static constexpr int width = W;
  template <int Width>
  using resized = ::ap_int<Width>;
};
template <int W>
struct VendorShape<::ap_uint<W>> {
  static constexpr int width = W;
  template <int Width>
  using resized = ::ap_uint<Width>;
};

template <class T>
concept vendor_integer = requires {
  VendorShape<T>::width;
};

}  // namespace hitpipe::hls

/// Bits Hi..Lo of x, unsigned, Hi-Lo+1 bits wide.
template <int Hi, int Lo, hitpipe::hls::vendor_integer T>
requires(hitpipe::hls::VendorShape<T>::width > Hi && Hi >= Lo &&
         Lo >= 0) inline ::ap_uint<Hi - Lo + 1> slice(const T& x) {
  return ::ap_uint<Hi - Lo + 1>(x.range(Hi, Lo));
}

/// The bits of a above those of b, unsigned, as wide as both.
template <hitpipe::hls::vendor_integer A, hitpipe::hls::vendor_integer B>
inline auto cat(const A& a, const B& b) {
  constexpr int wa = hitpipe::hls::VendorShape<A>::width;
  constexpr int wb = hitpipe::hls::VendorShape<B>::width;
  return ::ap_uint<wa + wb>(a.concat(b));
}

/// A multiplexer: a where the bit is 1, else b. A bit, not a bool or a wider word; a and b of one type.
template <std::same_as<::ap_uint<1>> Bit, hitpipe::hls::vendor_integer T>
inline T select(const Bit& bit, const T& a, const T& b) {
  return bit.to_bool() ? a : b;
}

/// x in W bits, of the same signedness: extended by its own sign, or its low W bits.
template <int W, hitpipe::hls::vendor_integer T>
inline auto resize(const T& x) {
  return typename hitpipe::hls::VendorShape<T>::template resized<W>(x);
}

/// Names a value in a traced graph; here x itself.
template <hitpipe::hls::vendor_integer T>
inline T as(const char* /*name*/, const T& x) {
  return x;
}
template <hitpipe::hls::vendor_integer T>
inline T as(const char* /*name*/, char /*axis*/, const T& x) {
  return x;
}
