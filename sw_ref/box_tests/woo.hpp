// Woo's test (section 2.3.2; Woo 1990) for infinite rays: of the at most three planes between the origin and
// the box, the one met last is where the ray enters, if that point lies in the face. The distance is that of
// entry, 0 if the origin is inside. Where two planes are met together, at an edge of the box, rounding can
// put that point outside the face: then the test misses a ray that goes on through the middle of the box.
#pragma once

#include <glm/vec3.hpp>

#include "sw_ref/geometry/aabb.hpp"
#include "sw_ref/geometry/ray.hpp"

namespace hitpipe::ref {

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

}  // namespace hitpipe::ref
