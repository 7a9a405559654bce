// The value domain in which the host's floating-point unit computes: integers as in the native domain, and
// float operators as one instruction in place of bit-level logic (hls/num/fp_logic.hpp). Both give the same
// patterns, which tests/rtl_gen/catalogue/host_float_test.cpp and bench/fp_bench.cpp show.
#pragma once

#include <bit>
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <limits>

#include "hls/box/fp_format.hpp"
#include "hls/num/domain.hpp"
#include "hls/num/fp.hpp"

namespace hitpipe::rtl {

struct HostFloat : hls::Native {};

/// The host's numbers in format F: a Number with - * < == as IEEE 754 has them, number(pattern) and
/// pattern(number). Formats that the host does not compute in have none.
template <class F>
struct HostNumbers;

// Only where the compiler keeps to IEEE 754 and rounds each result to binary32 at once. The files that run
// pipelines are compiled with -ffp-contract=off, so that no product is joined with a difference.
#if FLT_EVAL_METHOD == 0 && !defined(__FAST_MATH__)
template <>
struct HostNumbers<hls::Fp32> {
  static_assert(std::numeric_limits<float>::is_iec559);
  using Number = float;

  static Number number(std::uint32_t pattern) { return std::bit_cast<float>(pattern); }
  static std::uint32_t pattern(Number number) { return std::bit_cast<std::uint32_t>(number); }
};
#endif

template <class F>
concept host_format = requires {
  typename HostNumbers<F>::Number;
};

namespace detail {

template <class F>
auto host_number(const hls::Fp<HostFloat, F>& x) {
  return HostNumbers<F>::number(static_cast<std::uint32_t>(x.bits.word()));
}

/// A host has many NaN and keeps their payloads. The hardware has one.
template <class F>
hls::Fp<HostFloat, F> from_host(const typename HostNumbers<F>::Number& number, const F& format) {
  constexpr std::uint32_t nan = ((1U << (F::bits.exponent + 1)) - 1) << (F::bits.fraction - 1);
  return {{std::isnan(number) ? nan : HostNumbers<F>::pattern(number)}, format};
}

}  // namespace detail

// These are preferred to hls/num/fp.hpp's, because they are for one domain.
template <class F>
hls::Fp<HostFloat, F> fp_sub(const hls::Fp<HostFloat, F>& a, const hls::Fp<HostFloat, F>& b) {
  return detail::from_host(detail::host_number(a) - detail::host_number(b), a.format);
}
template <class F>
hls::Fp<HostFloat, F> fp_mul(const hls::Fp<HostFloat, F>& a, const hls::Fp<HostFloat, F>& b) {
  return detail::from_host(detail::host_number(a) * detail::host_number(b), a.format);
}
template <class F>
hls::Order<HostFloat::bit> fp_compare(const hls::Fp<HostFloat, F>& a, const hls::Fp<HostFloat, F>& b) {
  const auto x = detail::host_number(a);
  const auto y = detail::host_number(b);
  return {HostFloat::bit(x < y ? 1 : 0), HostFloat::bit(y < x ? 1 : 0)};
}

}  // namespace hitpipe::rtl
