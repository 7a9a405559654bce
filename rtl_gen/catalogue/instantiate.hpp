// Makes the instances of a pipeline, so that a format can be chosen at run time: of an integer pipeline
// tables of functions, one for tracing and one for the host, in translation units of their own because there
// are 864 n/t formats; of a float pipeline the one of binary32.
#pragma once

#include <array>
#include <utility>

#include "hls/box/arithmetic.hpp"
#include "hls/box/fp_format.hpp"
#include "hls/box/int_format.hpp"
#include "rtl_gen/catalogue/fp_formats.hpp"
#include "rtl_gen/catalogue/int_formats.hpp"

namespace hitpipe::rtl {

/// With HITPIPE_FEW_FORMATS (sanitizer and debug builds) only the formats of the thesis's tables and the ends
/// of the range are compiled; the others are then unknown to the program.
constexpr bool is_built(hls::IntBits bits) {
#ifdef HITPIPE_FEW_FORMATS
  const bool thesis =
      (bits.coord == 24 || bits.coord == 20 || bits.coord == 16) &&
      (bits.interval == bits.coord || bits.interval == bits.coord + 4 || bits.interval == bits.coord + 8);
  const bool end = (bits.coord == 6 || bits.coord == 12 || bits.coord == 32) &&
                   (bits.interval == hls::IntBits::min_interval || bits.interval == bits.coord ||
                    bits.interval == bits.product());
  return thesis || end;
#else
  return bits.valid();
#endif
}

namespace detail {

/// Make::entry<F>() for n/t, the default entry where is_built says no.
template <class Make, int N, int T>
constexpr typename Make::Entry entry_of() {
  if constexpr (is_built({N, T})) return Make::template entry<hls::IntFormat<N, T>>();
  return nullptr;
}

/// The same for t = 6 .. 2n-1.
template <class Make, int N, int... I>
typename Make::Entry of_coord(int t, std::integer_sequence<int, I...>) {
  constexpr int first = hls::IntBits::min_interval;
  static constexpr std::array<typename Make::Entry, sizeof...(I)> table{entry_of<Make, N, first + I>()...};
  return table[static_cast<std::size_t>(t - first)];
}

template <class Make, int... I>
typename Make::Entry of_bits(hls::IntBits bits, std::integer_sequence<int, I...>) {
  constexpr int first = hls::IntBits::min_coord;
  constexpr int spare = 1 - hls::IntBits::min_interval;
  typename Make::Entry found = nullptr;
  ((bits.coord == first + I &&
    (found = of_coord<Make, first + I>(
         bits.interval, std::make_integer_sequence<int, hls::IntBits{first + I, 0}.product() + spare>{}))),
   ...);
  return found;
}

}  // namespace detail

/// The function that Make gives for a format; null when the format is out of range or not built.
template <class Make>
typename Make::Entry for_format(Format format) {
  if constexpr (Make::arithmetic == hls::Arithmetic::floating) {
    return format.is<hls::FpBits>() ? Make::template entry<hls::Fp32>() : nullptr;
  } else {
    if (!format.is<hls::IntBits>() || !format.valid()) return nullptr;
    return detail::of_bits<Make>(
        format.as<hls::IntBits>(),
        std::make_integer_sequence<int, hls::IntBits::max_coord - hls::IntBits::min_coord + 1>{});
  }
}

}  // namespace hitpipe::rtl
