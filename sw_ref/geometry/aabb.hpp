// An axis-aligned bounding box: the closed set min <= p <= max.
#pragma once

#include <cstddef>
#include <cstring>
#include <limits>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

namespace hitpipe::ref {

struct Aabb {
  glm::vec3 min{std::numeric_limits<float>::infinity()};
  glm::vec3 max{-std::numeric_limits<float>::infinity()};

  void grow(const glm::vec3& p) {
    min = glm::min(min, p);
    max = glm::max(max, p);
  }
  void grow(const Aabb& box) {
    min = glm::min(min, box.min);
    max = glm::max(max, box.max);
  }

  /// Coordinate of face 0..5: min x, y, z, max x, y, z. A ray set-up picks near and far faces once by number,
  /// so that the test itself has no branch on the signs of the direction.
  [[nodiscard]] float plane(unsigned face) const {
    float value;
    std::memcpy(&value, reinterpret_cast<const std::byte*>(this) + sizeof(float) * face, sizeof value);
    return value;
  }
};
static_assert(sizeof(Aabb) == 6 * sizeof(float), "plane() reads six floats in a row");

}  // namespace hitpipe::ref
