// The value domain of a vendor's ap_int: compiles the pipelines against the headers of a user's HLS tool.
// <ap_int.h> comes from the user's folder (CMake HITPIPE_VENDOR_AP_INT). Only its documented ap_int and
// ap_uint are used. The functions below are global, as the vendor's types are, so that a pipeline's calls
// find them. hls/num/bits.hpp describes them. They return plain ap_uint or ap_int: a vendor's range() is a
// proxy as wide as its parent, and its comma does not concatenate two bools.
#pragma once

#include <cstdint>
#include <type_traits>

#include <ap_int.h>

#include "hls/num/bits.hpp"

namespace hitpipe {
namespace hls {

struct Vendor {
  template <int W>
  using sint = ::ap_int<W>;
  template <int W>
  using uint = ::ap_uint<W>;
  using bit = ::ap_uint<1>;

  template <int W>
  static ::ap_uint<W> lit(std::int64_t value, Width<W> /*width*/) {
    return value;
  }
};

/// Width and signedness of a vendor's integer. Other types have no such members, so the functions below do
/// not apply to them.
template <class T>
struct VendorShape;
template <int W>
struct VendorShape<::ap_int<W>> {
  static constexpr int width = W;
  template <int To>
  using resized = ::ap_int<To>;
};
template <int W>
struct VendorShape<::ap_uint<W>> {
  static constexpr int width = W;
  template <int To>
  using resized = ::ap_uint<To>;
};

}  // namespace hls
}  // namespace hitpipe

template <class T, int W = hitpipe::hls::VendorShape<T>::width>
inline hitpipe::hls::Width<W> width_of(const T& /*x*/) {
  return {};
}

template <int Hi, int Lo, class T, int W = hitpipe::hls::VendorShape<T>::width>
inline ::ap_uint<Hi - Lo + 1> slice(const T& x, hitpipe::hls::Width<Hi> /*high*/,
                                    hitpipe::hls::Width<Lo> /*low*/) {
  static_assert(Lo >= 0 && Hi >= Lo && Hi < W, "a slice lies inside its word");
  return ::ap_uint<Hi - Lo + 1>(x.range(Hi, Lo));
}

template <class A, class B, int Wa = hitpipe::hls::VendorShape<A>::width,
          int Wb = hitpipe::hls::VendorShape<B>::width>
inline ::ap_uint<Wa + Wb> cat(const A& a, const B& b) {
  return ::ap_uint<Wa + Wb>(a.concat(b));
}

/// `bit` must be a Bit, not a bool or a wider word; a and b have one type.
template <class Bit, class T, int W = hitpipe::hls::VendorShape<T>::width>
inline typename std::enable_if<std::is_same<Bit, ::ap_uint<1>>::value, T>::type select(const Bit& bit,
                                                                                       const T& a,
                                                                                       const T& b) {
  return bit != 0 ? a : b;
}

template <int To, class T>
inline typename hitpipe::hls::VendorShape<T>::template resized<To> resize(const T& x,
                                                                          hitpipe::hls::Width<To> /*width*/) {
  return typename hitpipe::hls::VendorShape<T>::template resized<To>(x);
}

template <class T, int W = hitpipe::hls::VendorShape<T>::width>
inline ::ap_int<W> as_signed(const T& x) {
  return ::ap_int<W>(x);
}
template <class T, int W = hitpipe::hls::VendorShape<T>::width>
inline ::ap_uint<W> as_unsigned(const T& x) {
  return ::ap_uint<W>(x);
}

template <class T, int W = hitpipe::hls::VendorShape<T>::width>
inline T as(const char* /*name*/, const T& x) {
  return x;
}
template <class T, int W = hitpipe::hls::VendorShape<T>::width>
inline T as(const char* /*name*/, char /*axis*/, const T& x) {
  return x;
}
