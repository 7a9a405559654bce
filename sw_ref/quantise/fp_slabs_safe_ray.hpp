// Ray set-up for the float slabs unit that never misses (docs/never_misses.md): bounds of the origin and of
// the inverse direction in any format eEmM, and the length. Every bound is exact: the code computes with
// integers made of the binary32's mantissas and exponents. Directions are scaled by a power of two, so that
// the largest component is in (1/2, 1] and no inverse is below 1.
#pragma once

#include <array>
#include <cstdint>

#include "hls/box/fp_format.hpp"
#include "rays/mesh/ray.hpp"

namespace hitpipe::ref {

struct FpSlabsSafeRay {
  std::array<bool, 3> back{};                                 ///< the direction is negative; -0 is too
  std::array<float, 3> origin_low{}, origin_high{};           ///< mirrored where `back` is set
  std::array<std::int64_t, 3> inverse_low{}, inverse_high{};  ///< patterns without sign, 1 to infinity

  friend bool operator==(const FpSlabsSafeRay&, const FpSlabsSafeRay&) = default;
};

struct FpSlabsSafeEnd {
  std::int64_t length = 0;  ///< pattern without sign
  bool endless = false;     ///< the unit ignores `length`, which is infinity

  friend bool operator==(const FpSlabsSafeEnd&, const FpSlabsSafeEnd&) = default;
};

class FpSlabsSafeRaySetup {
 public:
  /// Needs an acceptable ray (see box_referee.hpp). Throws std::out_of_range for an origin outside [-1, 1]^3,
  /// and std::invalid_argument otherwise.
  FpSlabsSafeRaySetup(const Ray& ray, const hls::FpBits& bits);

  [[nodiscard]] const FpSlabsSafeRay& ray() const { return ray_; }
  /// Where the ray ends if it ends at `length`. It is endless in the unit if its end is beyond the largest
  /// number. Throws std::invalid_argument unless length >= 0 or infinite.
  [[nodiscard]] FpSlabsSafeEnd end(float length) const;

 private:
  FpSlabsSafeRay ray_;
  hls::FpBits bits_;
  int scale_;  ///< the smallest s for which no component exceeds 2^s
};

}  // namespace hitpipe::ref
