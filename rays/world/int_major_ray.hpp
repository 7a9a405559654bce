// Ray set-up for the units with a major axis (docs/never_misses.md): the origin on its fine grid, and for the two
// other axes bounds of the quotient |D_M| / |D_k|, where M is the axis of the direction's largest component.
// Every result is exact: the code computes with integers made of the binary32's mantissas and exponents.
#pragma once

#include <array>
#include <cstdint>

#include "hls/box/major_format.hpp"
#include "rays/exact/major_quotient.hpp"
#include "rays/mesh/ray.hpp"

namespace hitpipe::ref {

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
