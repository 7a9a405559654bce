// Decodes a box from codes relative to its parent's box (section 5.3), in binary32: coordinate = min of the
// parent + code * step. A step is 1 / (2^bits - 1) of the parent's side. Encoder and traversal use the same
// functions, so what the encoder checks holds for the traversal bit for bit.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "rays/mesh/aabb.hpp"

#ifdef __FAST_MATH__
#error "decoded boxes must be the same bits everywhere: build without -ffast-math"
#endif

namespace hitpipe::ref {

/// 2^bits - 1.
template <int bits>
inline constexpr std::uint32_t top_code = (std::uint32_t{1} << bits) - 1;

/// Four lanes of a vector register.
using Four = float __attribute__((vector_size(16)));
using FourWords = std::int32_t __attribute__((vector_size(16)));

/// start + a * b. If fused multiply-add is fast, a compiler may or may not use it, so the code asks for it.
/// Otherwise two statements ensure two roundings. Lanes and single floats give the same bits.
[[nodiscard]] inline float sum_of_product(float start, float a, float b) {
#ifdef __FP_FAST_FMAF
  return std::fma(a, b, start);
#else
  const float product = a * b;
  return start + product;
#endif
}
[[nodiscard]] inline Four sum_of_product(Four start, Four a, Four b) {
#ifdef __FP_FAST_FMAF
  return Four{std::fma(a[0], b[0], start[0]), std::fma(a[1], b[1], start[1]), std::fma(a[2], b[2], start[2]),
              std::fma(a[3], b[3], start[3])};
#else
  const Four product = a * b;
  return start + product;
#endif
}

/// A step is this share of the parent's side, and a little more (see RelativeFrame).
template <int bits>
inline constexpr float step_share = (1.0F + 0x1p-21F) / static_cast<float>(top_code<bits>);

/// The steps of one parent.
template <int bits>
class RelativeFrame {
 public:
  static constexpr std::uint32_t top = top_code<bits>;

  /// Code 0 is exactly the parent's min, and the top code N = 2^bits - 1 reaches its max. Proof: let u =
  /// 2^-24 and w = max - min. The difference, the product with the share and the sum are rounded once each.
  /// The product may underflow by 2^-150; the added 2^-126 more than covers that:
  ///     step >= w (1 - u)^3 share,   share >= (1 + 8 u) (1 - u) / N,   and step >= 2^-126 (w >= 0).
  /// So no product code * step underflows, and N step rounded is >= w (1 - u)^5 (1 + 8 u) >= w. The sum min +
  /// N step is >= max before rounding, and also after it, because rounding is monotone and max is a float.
  /// All this holds for w = 0 too: the steps are then 2^-126, and every code decodes to min or beyond. The
  /// top code ends at most 13 u w + 2 u beyond max; a chain of 60 levels that all do so ends less than 2^-13
  /// beyond.
  explicit RelativeFrame(const Aabb& parent)
      : origin_(parent.min),
        step_(step_of(parent.max.x - parent.min.x), step_of(parent.max.y - parent.min.y),
              step_of(parent.max.z - parent.min.z)) {}

  [[nodiscard]] float decoded(int axis, float code) const {
    return sum_of_product(origin_[axis], step_[axis], code);
  }
  [[nodiscard]] float origin(int axis) const { return origin_[axis]; }
  [[nodiscard]] float step(int axis) const { return step_[axis]; }

 private:
  static float step_of(float width) {
    return sum_of_product(std::numeric_limits<float>::min(), width, step_share<bits>);
  }

  glm::vec3 origin_;
  glm::vec3 step_;
};
/// Tables that turn a byte into a float: all 8 bits, its lower 4 bits, and its upper 4 bits (section 5.4).
struct CodeTables {
  std::array<float, 256> whole{};
  std::array<float, 256> low{};
  std::array<float, 256> high{};

  constexpr CodeTables() {
    for (std::size_t byte = 0; byte < 256; ++byte) {
      whole[byte] = static_cast<float>(byte);
      low[byte] = static_cast<float>(byte & 15U);
      high[byte] = static_cast<float>(byte >> 4U);
    }
  }
};
inline constexpr CodeTables code_tables;

/// The code of min (the lower half of an axis' 2 * bits) or of max (the upper) as a float. `codes` may have
/// other bits above.
template <int bits, bool lut, bool of_max>
[[nodiscard]] inline float code_value(std::uint32_t codes) {
  if constexpr (lut && bits == 4) {
    return (of_max ? code_tables.high : code_tables.low)[codes & 255U];
  } else {
    const std::uint32_t code = codes >> (of_max ? bits : 0) & top_code<bits>;
    if constexpr (lut) return code_tables.whole[code];
    return static_cast<float>(static_cast<std::int32_t>(code));
  }
}

}  // namespace hitpipe::ref
