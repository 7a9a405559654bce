// What the set-ups of rays with a major axis share: bounds of a quotient of two direction components, and a
// length along the major axis. Both are exact.
#pragma once

#include <cstdint>

#include <glm/vec3.hpp>

#include "hls/box/major_format.hpp"

namespace hitpipe::ref {

/// mantissa_low 2^exponent <= 2^(p-1) q <= mantissa_high 2^exponent for a quotient q >= 1, unless q is too
/// large for that. Then both mantissas and the exponent are the largest.
struct MajorQuotient {
  std::uint32_t mantissa_low = 0;   ///< p bits, at least 2^(p-1) - 1
  std::uint32_t mantissa_high = 0;  ///< p bits, at least 2^(p-1); mantissa_low or mantissa_low + 1
  int exponent = 0;                 ///< 0..n+g-1

  friend bool operator==(const MajorQuotient&, const MajorQuotient&) = default;
};

/// Both mantissas and the exponent are the largest.
[[nodiscard]] MajorQuotient largest_quotient(const hls::MajorBits& bits);

/// Bounds of above / below 2^exponent, which is at least 1. Both numbers have the same leading bit.
[[nodiscard]] MajorQuotient quotient_bounds(std::uint64_t above, std::uint64_t below, int exponent,
                                            const hls::MajorBits& bits);
/// Of above / below, which is at least 1, in the integer world: where below is 0, both mantissas are 2^(p-1) with the
/// largest exponent.
[[nodiscard]] MajorQuotient quotient_of(std::uint64_t above, std::uint64_t below, const hls::MajorBits& bits);

/// The axis of the largest component; ties go to the lower axis.
[[nodiscard]] int major_axis(const glm::vec3& direction);

/// floor(length major G 2^fraction), at most `largest`, which stands for an infinite length too. `coord` is n
/// of the grid; length >= 0, major >= 0, fraction in -2..11, largest below 2^40.
[[nodiscard]] std::int64_t length_along_major(float length, float major, int coord, int fraction,
                                              std::int64_t largest);

}  // namespace hitpipe::ref
