// Woo's test (section 2.3.2; Woo 1990) for infinite rays. At most three planes lie between the origin and the
// box. The ray enters at the plane that it meets last, if that point lies in the face. The distance is where
// it enters, 0 if the origin is inside. At an edge of the box the ray meets two planes together. Rounding can
// then put the point outside the face, and the test misses a ray that goes through the middle of the box.
#pragma once

#include <glm/vec3.hpp>

#include "rays/mesh/aabb.hpp"
#include "rays/mesh/ray.hpp"
#include "thesis/reference.hpp"

namespace hitpipe::thesis {

template <class T>
struct Woo {
  static constexpr bool has_distance = true;

  struct Ray {
    glm::vec<3, T> origin, direction;

    explicit Ray(const ref::Ray& ray) : origin(ray.origin), direction(ray.direction) {}
  };

  static bool test(const Ray& ray, const BasicAabb<T>& box, T& entry) {
    entry = -1;
    int entered = 0;
    bool inside = true;
    for (int axis = 0; axis < 3; ++axis) {
      const T o = ray.origin[axis];
      if (o >= box.min[axis] && o <= box.max[axis]) continue;
      inside = false;
      if (ray.direction[axis] == 0) return false;
      const T t = ((o < box.min[axis] ? box.min[axis] : box.max[axis]) - o) / ray.direction[axis];
      if (t > entry) {
        entry = t;
        entered = axis;
      }
    }
    if (inside) {
      entry = 0;
      return true;
    }
    if (entry < 0) return false;
    for (int axis = 0; axis < 3; ++axis) {
      if (axis == entered) continue;
      const T at = ray.origin[axis] + entry * ray.direction[axis];
      if (at < box.min[axis] || at > box.max[axis]) return false;
    }
    return true;
  }
};

}  // namespace hitpipe::thesis
