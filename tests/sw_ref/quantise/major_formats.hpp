// Formats n+g/p for tests: all that a test's n and g allow, drawn at random.
#pragma once

#include <string>

#include <fmt/format.h>

#include "hls/box/major_format.hpp"
#include "sw_ref/judge/adversary/random.hpp"

namespace hitpipe::ref {

/// The format as the program spells it, always with its fraction.
inline std::string name_of(hls::MajorBits bits) {
  return fmt::format("{}+{}/{}f{}", bits.coord, bits.finer, bits.mantissa, bits.fraction);
}

/// Any p and F for which the proofs hold.
inline hls::MajorBits major_bits(adversary::Random& random, int coord, int finer) {
  hls::MajorBits bits;
  do {
    bits = {coord, finer, random.between(hls::MajorBits::min_proved_mantissa, hls::MajorBits::max_mantissa),
            random.between(hls::MajorBits::min_fraction, hls::MajorBits::max_fraction)};
  } while (!bits.proved());
  return bits;
}

}  // namespace hitpipe::ref
