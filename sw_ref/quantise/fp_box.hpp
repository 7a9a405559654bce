// Numbers and boxes in a float format eEmM, rounded to one side. Numbers of the format are kept as binary32,
// which holds them all.
#pragma once

#include <cstdint>

#include "hls/box/fp_format.hpp"
#include "rays/mesh/aabb.hpp"

namespace hitpipe::ref {

/// Rounds numbers of [-1, 1] to the numbers of a format.
class FpRounding {
 public:
  explicit FpRounding(const hls::FpBits& bits);

  /// The largest number of the format that is not above x. A zero has the sign of x.
  [[nodiscard]] float down(float x) const;
  /// The smallest number of the format that is not below x.
  [[nodiscard]] float up(float x) const { return -down(-x); }
  /// Lower planes are rounded down and upper planes up. A lower plane at 0 becomes -0, an upper plane +0: the
  /// unit needs these signs.
  [[nodiscard]] Aabb outward(const Aabb& box) const;

 private:
  double least_normal_;
  double subnormal_unit_, in_subnormal_units_;
  int cut_;  ///< bits of a binary32's fraction that the format does not have
};

/// The pattern of a finite number of the format.
[[nodiscard]] std::int64_t fp_pattern(float x, const hls::FpBits& bits);
/// The number that a pattern without a sign stands for.
[[nodiscard]] double fp_number(std::int64_t magnitude, const hls::FpBits& bits);

/// Throws std::out_of_range if a coordinate is not in [-1, 1], and std::invalid_argument for a format that
/// there is not.
[[nodiscard]] Aabb round_box(const Aabb& box, const hls::FpBits& bits);

}  // namespace hitpipe::ref
