// An axis-aligned bounding box: the closed set min <= p <= max.
#pragma once

#include <cstddef>
#include <cstring>
#include <limits>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

namespace hitpipe::ref {

/// Empty until it is grown. T: float, as nodes store it, or double (section 5.7).
template <class T>
struct BasicAabb {
  glm::vec<3, T> min{std::numeric_limits<T>::infinity()};
  glm::vec<3, T> max{-std::numeric_limits<T>::infinity()};

  void grow(const glm::vec<3, T>& p) {
    min = glm::min(min, p);
    max = glm::max(max, p);
  }
  void grow(const BasicAabb& box) {
    min = glm::min(min, box.min);
    max = glm::max(max, box.max);
  }

  /// Coordinate of face 0..5: min x, y, z, max x, y, z. A ray set-up picks the numbers of the near and far
  /// faces once, so the test has no branch on the signs of the direction.
  [[nodiscard]] T plane(unsigned face) const {
    static_assert(sizeof(BasicAabb) == 6 * sizeof(T), "six coordinates in a row");
    T value;
    std::memcpy(&value, reinterpret_cast<const std::byte*>(this) + sizeof(T) * face, sizeof value);
    return value;
  }
};
using Aabb = BasicAabb<float>;

/// The inner box is not empty, and no part of it is outside the outer one. False also for NaN.
[[nodiscard]] inline bool encloses(const Aabb& outer, const Aabb& inner) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!(outer.min[axis] <= inner.min[axis] && inner.min[axis] <= inner.max[axis] &&
          inner.max[axis] <= outer.max[axis])) {
      return false;
    }
  }
  return true;
}

}  // namespace hitpipe::ref
