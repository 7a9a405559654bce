// The three float operators on patterns, for tables of them.
#pragma once

#include <cstdint>

#include "hls/box/fp_format.hpp"
#include "hls/num/domain.hpp"
#include "hls/num/fp_logic.hpp"

namespace hitpipe::hls::exact {

using FloatOperator = std::uint64_t (*)(std::uint64_t a, std::uint64_t b);

template <int E, int M>
std::uint64_t subtract_bits(std::uint64_t a, std::uint64_t b) {
  using Bits = ap_uint<1 + E + M>;
  return fp_logic::subtract<Native>(FpFormat<E, M>(), Bits(a), Bits(b)).to_uint64();
}
template <int E, int M>
std::uint64_t multiply_bits(std::uint64_t a, std::uint64_t b) {
  using Bits = ap_uint<1 + E + M>;
  return fp_logic::multiply<Native>(FpFormat<E, M>(), Bits(a), Bits(b)).to_uint64();
}
template <int E, int M>
std::uint64_t compare_bits(std::uint64_t a, std::uint64_t b) {
  using Bits = ap_uint<1 + E + M>;
  return fp_logic::compare<Native>(FpFormat<E, M>(), Bits(a), Bits(b)).to_uint64();
}

}  // namespace hitpipe::hls::exact
