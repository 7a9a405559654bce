// What core.hpp says of each word of the registers.
#pragma once

#include <algorithm>
#include <cstdint>

// What becomes of a number that is written.
enum class Fit {
  largest,   // one that has too many bits becomes the largest
  from_one,  // likewise, and 0 becomes 1
  cut        // bits that the word does not keep are lost
};
// What a soft reset does to a word that is written.
enum class SoftReset {
  keeps,
  clears,  // it becomes 0 at the end
  holds    // it is 0 as long as the reset lasts
};

struct RegisterWord {
  uint32_t at;     // in bytes
  uint32_t kept;   // bits that keep what is written
  uint32_t value;  // after a hard reset
  Fit fit;
  SoftReset soft_reset;
  bool is_setting;  // anything may be written at any time
  bool is_counter;  // the low or the high word of one

  constexpr uint32_t fitting(uint32_t written) const {
    if (fit == Fit::cut) return written & kept;
    return std::max(std::min(written, kept), uint32_t{fit == Fit::from_one});
  }
};
