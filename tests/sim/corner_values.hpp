// Values at the corners of a port, by name: bit patterns where arithmetic breaks. A float port has 32 bits
// and is unsigned.
#pragma once

#include <cstdint>
#include <vector>

#include "rtl_gen/catalogue/design.hpp"

namespace hitpipe::sim {

struct CornerValue {
  const char* name;
  std::int64_t value;
};

/// 2^(w-1): one more than the largest value of a signed port.
inline std::int64_t top(const rtl::Port& port) {
  return std::int64_t{1} << (port.width - 1);
}

/// For a signed port of w bits.
inline std::vector<CornerValue> integer_corners(const rtl::Port& port) {
  return {{"zero", 0},
          {"one", 1},
          {"-1: every bit set", -1},
          {"greatest", top(port) - 1},
          {"least", -top(port)},
          {"the grid's end G", top(port) / 2 - 1},
          {"-G", -(top(port) / 2 - 1)},
          {"one past the grid, of an outward rounded box", top(port) / 2},
          {"one past it downwards", -top(port) / 2},
          {"bits 0101", std::int64_t{0x5555555555555555} & (top(port) - 1)}};
}

/// For an unsigned integer port of w bits.
inline std::vector<CornerValue> natural_corners(const rtl::Port& port) {
  return {{"zero", 0},
          {"one", 1},
          {"every bit set", 2 * top(port) - 1},
          {"all but the lowest", 2 * top(port) - 2},
          {"the top bit alone", top(port)},
          {"all but the top bit", top(port) - 1}};
}

/// binary32 patterns.
inline std::vector<CornerValue> float_corners() {
  return {{"+0", 0x00000000},
          {"-0", 0x80000000},
          {"smallest subnormal", 0x00000001},
          {"smallest subnormal, negative", 0x80000001},
          {"largest subnormal", 0x007FFFFF},
          {"smallest normal", 0x00800000},
          {"1", 0x3F800000},
          {"-1", 0xBF800000},
          {"next below 1", 0x3F7FFFFF},
          {"next above 1", 0x3F800001},
          {"largest", 0x7F7FFFFF},
          {"largest, negative", 0xFF7FFFFF},
          {"infinity", 0x7F800000},
          {"-infinity", 0xFF800000},
          {"canonical NaN", 0x7FC00000},
          {"negative NaN with other fraction bits", 0xFFC12345},
          {"signalling NaN", 0x7F800001}};
}

}  // namespace hitpipe::sim
