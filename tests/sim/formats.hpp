// Integer slabs in the formats of the tests that run units: the thesis's two, narrow formats, and both ends
// of the range.
#pragma once

#include <array>
#include <ostream>
#include <string>

#include "tests/sim/units.hpp"

namespace hitpipe::hls {

/// Prints a format for GoogleTest.
inline void PrintTo(const IntBits& bits, std::ostream* out) {
  *out << bits.coord << '/' << bits.interval;
}

}  // namespace hitpipe::hls

namespace hitpipe::sim {

inline constexpr std::array<hls::IntBits, 6> formats{
    {{24, 24}, {20, 24}, {16, 16}, {12, 12}, {6, 6}, {32, 63}}};

/// "24_24", for a test's name.
inline std::string test_name(hls::IntBits bits) {
  return std::to_string(bits.coord) + "_" + std::to_string(bits.interval);
}

inline const rtl::Design& int_slabs() {
  return rtl::find_design("int_slabs");
}

inline const VerilatedDesign& verilated(hls::IntBits bits) {
  return verilated(TestedUnit{"int_slabs", bits});
}

}  // namespace hitpipe::sim
