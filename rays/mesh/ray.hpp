// A ray as every traversal receives it: points origin + t * direction, 0 <= t <= length (section 2.3).
#pragma once

#include <cmath>
#include <limits>

#include <glm/vec3.hpp>

namespace hitpipe::ref {

struct Ray {
  static constexpr float infinite = std::numeric_limits<float>::infinity();

  glm::vec3 origin{0};      ///< each component in [-1, 1]
  glm::vec3 direction{0};   ///< finite, not all zero; need not have unit length
  float length = infinite;  ///< largest t, in units of `direction`; >= 0, or `infinite`

  [[nodiscard]] bool is_infinite() const { return std::isinf(length); }
};

/// Where a ray enters and leaves a box, in the whole units of a datapath's results.
struct RayInterval {
  std::int64_t near, far;
};

}  // namespace hitpipe::ref
