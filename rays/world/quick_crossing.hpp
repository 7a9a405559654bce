// int_crossing() and crossing_of() for tracers: in 64 bits where the format allows.
#pragma once

#include <cstdint>
#include <optional>

#include "hls/world/world_format.hpp"
#include "rays/world/crossing.hpp"

namespace hitpipe::ref {

/// Thread-safe.
class QuickCrossing {
 public:
  explicit QuickCrossing(const hls::WorldBits& bits);

  /// T of int_crossing().
  [[nodiscard]] std::optional<std::int64_t> distance(const IntRay& ray, const IntTriangle& triangle) const;
  /// As crossing_of().
  [[nodiscard]] std::optional<Crossing> crossing(const IntRay& ray, const IntTriangle& triangle) const;

 private:
  [[nodiscard]] std::optional<Crossing> in_64_bits(const IntRay& ray, const IntTriangle& triangle) const;

  hls::WorldBits bits_;
  double distance_scale_;  ///< 2^(S + F)
  bool fits_;
};

}  // namespace hitpipe::ref
