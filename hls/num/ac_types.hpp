// The value domain of Siemens' open ac_types: compiles the pipelines against <ac_int.h> of a user's HLS tool
// (Catapult) or of the public repository. Only ac_int's documented members slc and set_slc, constructors and
// operators are used. The functions below are global, as ac_int is, so that a pipeline's calls find them.
// hls/num/bits.hpp describes them.
//   ~x of an ac_int is the signed number -x-1, one bit wider than an unsigned x. Its low bits are
//   right, so a pipeline stores an inverted bit in a Bit before a function reads its width.
#pragma once

#include <cstdint>
#include <type_traits>

#include <ac_int.h>

#include "hls/num/bits.hpp"

namespace hitpipe {
namespace hls {

struct AcTypes {
  template <int W>
  using sint = ::ac_int<W, true>;
  template <int W>
  using uint = ::ac_int<W, false>;
  using bit = ::ac_int<1, false>;

  template <int W>
  static ::ac_int<W, false> lit(std::int64_t value, Width<W> /*width*/) {
    return value;
  }
};

}  // namespace hls
}  // namespace hitpipe

template <int W, bool S>
inline hitpipe::hls::Width<W> width_of(const ::ac_int<W, S>& /*x*/) {
  return {};
}

template <int Hi, int Lo, int W, bool S>
inline ::ac_int<Hi - Lo + 1, false> slice(const ::ac_int<W, S>& x, hitpipe::hls::Width<Hi> /*high*/,
                                          hitpipe::hls::Width<Lo> /*low*/) {
  static_assert(Lo >= 0 && Hi >= Lo && Hi < W, "a slice lies inside its word");
  return x.template slc<Hi - Lo + 1>(Lo);
}

template <int Wa, bool Sa, int Wb, bool Sb>
inline ::ac_int<Wa + Wb, false> cat(const ::ac_int<Wa, Sa>& a, const ::ac_int<Wb, Sb>& b) {
  ::ac_int<Wa + Wb, false> both = 0;
  both.set_slc(Wb, ::ac_int<Wa, false>(a));
  both.set_slc(0, ::ac_int<Wb, false>(b));
  return both;
}

/// `bit` must be a Bit, not a bool or a wider word; a and b have one type.
template <class Bit, int W, bool S>
inline typename std::enable_if<std::is_same<Bit, ::ac_int<1, false>>::value, ::ac_int<W, S>>::type select(
    const Bit& bit, const ::ac_int<W, S>& a, const ::ac_int<W, S>& b) {
  return bit != 0 ? a : b;
}

template <int To, int W, bool S>
inline ::ac_int<To, S> resize(const ::ac_int<W, S>& x, hitpipe::hls::Width<To> /*width*/) {
  return x;
}

template <int W, bool S>
inline ::ac_int<W, true> as_signed(const ::ac_int<W, S>& x) {
  return x;
}
template <int W, bool S>
inline ::ac_int<W, false> as_unsigned(const ::ac_int<W, S>& x) {
  return x;
}

template <int W, bool S>
inline ::ac_int<W, S> as(const char* /*name*/, const ::ac_int<W, S>& x) {
  return x;
}
template <int W, bool S>
inline ::ac_int<W, S> as(const char* /*name*/, char /*axis*/, const ::ac_int<W, S>& x) {
  return x;
}
