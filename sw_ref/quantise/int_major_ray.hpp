// Ray set-up for the units with a major axis (docs/major.md): the origin on its fine grid, and for the two
// other axes bounds of the quotient |D_M| / |D_k|, where M is the axis of the direction's largest component.
// Every result is exact: the code computes with integers made of the binary32's mantissas and exponents.
#pragma once

#include <array>
#include <cstdint>

#include "hls/box/major_format.hpp"
#include "sw_ref/scene/ray.hpp"

namespace hitpipe::ref {

/// mantissa_low 2^exponent <= 2^(p-1) |D_M| / |D_k| <= mantissa_high 2^exponent, unless the quotient is too
/// large for that. Then both mantissas and the exponent are the largest.
struct MajorQuotient {
  std::uint32_t mantissa_low = 0;   ///< p bits, at least 2^(p-1) - 1
  std::uint32_t mantissa_high = 0;  ///< p bits, at least 2^(p-1); mantissa_low or mantissa_low + 1
  int exponent = 0;                 ///< 0..n+g-1

  friend bool operator==(const MajorQuotient&, const MajorQuotient&) = default;
};

struct IntMajorRay {
  std::array<int, 3> axes{};       ///< which axis ray axis m, a and b is (hls/box/int_major_operands.hpp)
  std::array<bool, 3> backward{};  ///< by ray axis: the direction is negative
  std::array<std::int64_t, 3> origin{};  ///< by ray axis: x on the grid of n+g bits, or -x - 1 where backward
  std::array<MajorQuotient, 2> quotient;  ///< of ray axes a and b

  friend bool operator==(const IntMajorRay&, const IntMajorRay&) = default;
};

/// The exact set-up of one ray for a major-axis unit.
class IntMajorRaySetup {
 public:
  /// Needs an acceptable ray (see box_referee.hpp) and a valid format. Throws std::out_of_range for an origin
  /// outside [-1, 1]^3, and std::invalid_argument otherwise.
  IntMajorRaySetup(const Ray& ray, hls::MajorBits bits);

  [[nodiscard]] const IntMajorRay& ray() const { return ray_; }
  /// floor(length |D_M| G 2^F), at most the largest length in the cube, which stands for an infinite one too.
  /// Throws std::invalid_argument unless length >= 0.
  [[nodiscard]] std::int64_t length(float length) const;

 private:
  hls::MajorBits bits_;
  IntMajorRay ray_;
  float major_ = 0;  ///< |D_M|
};

}  // namespace hitpipe::ref
