// Random numbers that are the same on every machine: integer hashes, no distribution of the standard library.
// Noise is a sum of random values at integer points, smoothly interpolated.
#pragma once

#include <cmath>
#include <cstdint>

#include <glm/vec3.hpp>

namespace hitpipe::ref {

/// The finaliser of splitmix64 (Steele, Lea and Flood 2014): a permutation in which all bits mix.
[[nodiscard]] inline std::uint64_t mixed(std::uint64_t x) {
  x = (x ^ x >> 30U) * 0xBF58476D1CE4E5B9U;
  x = (x ^ x >> 27U) * 0x94D049BB133111EBU;
  return x ^ x >> 31U;
}

/// What splitmix64 adds to its state for each number: 2^64 divided by the golden ratio.
constexpr std::uint64_t golden_step = 0x9E3779B97F4A7C15U;

/// Write two throws as two statements: in one expression the compiler chooses their order.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : state_(mixed(seed)) {}

  /// In [0, 1).
  double next() {
    state_ += golden_step;
    return static_cast<double>(mixed(state_) >> 11U) * 0x1p-53;
  }
  double between(double low, double high) { return low + (high - low) * next(); }
  /// 0 .. count-1.
  int below(int count) { return static_cast<int>(next() * count); }
  bool chance(double part) { return next() < part; }

 private:
  std::uint64_t state_;
};

/// In [-1, 1], random at integer points and smooth between them; |p| is below 2^20.
[[nodiscard]] double noise(const glm::dvec3& p);

/// `octaves` noises, each of twice the frequency and half the height of the one before; in (-2, 2).
[[nodiscard]] double layered_noise(glm::dvec3 p, int octaves);

}  // namespace hitpipe::ref
