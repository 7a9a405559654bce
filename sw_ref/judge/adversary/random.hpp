// A seeded random engine. It does not use the distributions of the standard library, so a seed gives the same
// cases on every machine.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "sw_ref/scene/noise.hpp"

namespace hitpipe::ref::adversary {

class Random {
 public:
  /// The state is four draws of SplitMix64, as the authors of the engine advise. It is never all zero.
  explicit Random(std::uint64_t seed) {
    for (std::uint64_t& word : state_) word = mixed(seed += golden_step);
  }

  /// xoshiro256** (Blackman and Vigna, 2018).
  std::uint64_t bits() {
    const std::uint64_t drawn = std::rotl(state_[1] * 5, 7) * 9;
    const std::uint64_t shifted = state_[1] << 17;
    state_[2] ^= state_[0];
    state_[3] ^= state_[1];
    state_[1] ^= state_[2];
    state_[0] ^= state_[3];
    state_[2] ^= shifted;
    state_[3] = std::rotl(state_[3], 45);
    return drawn;
  }
  /// Less than `count`, from the upper half of a product, without a division. The bias of count / 2^64 is
  /// negligible here.
  std::uint64_t below(std::uint64_t count) {
    return static_cast<std::uint64_t>(static_cast<Uint128>(bits()) * count >> 64);
  }
  int between(int low, int high) {
    return low +
           static_cast<int>(below(static_cast<std::uint64_t>(high) - static_cast<std::uint64_t>(low) + 1));
  }
  bool coin() { return below(2) == 0; }
  int axis() { return between(0, 2); }
  float sign() { return coin() ? 1.0F : -1.0F; }
  float signed_zero() { return coin() ? 0.0F : -0.0F; }
  /// In [-1, 1], with full precision.
  float signed_unit() { return static_cast<float>(static_cast<double>(bits() >> 11) * 0x1p-52 - 1.0); }
  /// A multiple of 2^-6 in [-63/64, 63/64].
  float coarse() { return static_cast<float>(between(-63, 63)) * 0x1p-6F; }
  /// +-m 2^e, 1 <= m < 2; exponents below -126 give subnormals.
  float of_exponent(int low, int high) {
    const float mantissa = 1.0F + static_cast<float>(below(1U << 23)) * 0x1p-23F;
    return sign() * std::ldexp(mantissa, between(low, high));
  }

 private:
  __extension__ using Uint128 = unsigned __int128;

  std::array<std::uint64_t, 4> state_{};
};

}  // namespace hitpipe::ref::adversary
