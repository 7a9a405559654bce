// False colours for heat maps and depth: nine anchors at even steps of viridis (S. van der Walt and N. Smith,
// CC0), linearly interpolated. The map is perceptually uniform and readable for the colour-blind.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace hitpipe::ref {

/// sRGB codes.
using Srgb = std::array<std::uint8_t, 3>;

/// 0 is dark violet and 1 is yellow. Outside [0, 1] it is the nearer end. NaN is black, which no number maps
/// to.
[[nodiscard]] inline Srgb viridis(float x) {
  constexpr std::array<Srgb, 9> anchors{{{0x44, 0x01, 0x54},
                                         {0x47, 0x2D, 0x7B},
                                         {0x3B, 0x52, 0x8B},
                                         {0x2C, 0x72, 0x8E},
                                         {0x21, 0x90, 0x8C},
                                         {0x27, 0xAD, 0x81},
                                         {0x5D, 0xC8, 0x63},
                                         {0xAA, 0xDC, 0x32},
                                         {0xFD, 0xE7, 0x25}}};
  if (std::isnan(x)) return {0, 0, 0};
  const float at = std::clamp(x, 0.0F, 1.0F) * (anchors.size() - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(at), anchors.size() - 2);
  Srgb colour{};
  for (std::size_t k = 0; k < colour.size(); ++k) {
    const float mixed = std::lerp(static_cast<float>(anchors[below][k]),
                                  static_cast<float>(anchors[below + 1][k]), at - static_cast<float>(below));
    colour[k] = static_cast<std::uint8_t>(std::lround(mixed));
  }
  return colour;
}

}  // namespace hitpipe::ref
