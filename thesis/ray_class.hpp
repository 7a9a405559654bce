// The eight ray classes of section 3.3, MMM to PPP, as compile-time constants: a box test is written once for
// all classes, and each class knows its planes at compile time.
#pragma once

#include <cmath>
#include <utility>

#include <glm/vec3.hpp>

#include "rays/mesh/aabb.hpp"
#include "rays/mesh/ray.hpp"
#include "thesis/reference.hpp"

namespace hitpipe::thesis {

/// `signs`: bits 0..2 for x, y, z, 1 for minus (-0 included).
template <unsigned signs>
struct RayClass {
  /// 1 for minus.
  static constexpr bool minus(int axis) { return (signs >> static_cast<unsigned>(axis) & 1U) != 0; }

  /// The coordinates of the box that a ray of this class meets first, and last.
  template <class T>
  static glm::vec<3, T> entry(const BasicAabb<T>& box) {
    return {minus(0) ? box.max.x : box.min.x, minus(1) ? box.max.y : box.min.y,
            minus(2) ? box.max.z : box.min.z};
  }
  template <class T>
  static glm::vec<3, T> exit(const BasicAabb<T>& box) {
    return entry(BasicAabb<T>{box.max, box.min});
  }
};

/// Calls visit(RayClass<signs>{}).
template <class Visit>
decltype(auto) with_ray_class(unsigned signs, Visit&& visit) {
  switch (signs) {
    case 0:
      return visit(RayClass<0>{});
    case 1:
      return visit(RayClass<1>{});
    case 2:
      return visit(RayClass<2>{});
    case 3:
      return visit(RayClass<3>{});
    case 4:
      return visit(RayClass<4>{});
    case 5:
      return visit(RayClass<5>{});
    case 6:
      return visit(RayClass<6>{});
    default:
      return visit(RayClass<7>{});
  }
}

/// A ray that knows its class.
template <class T>
struct ClassedRay {
  glm::vec<3, T> origin, direction;
  unsigned signs;

  explicit ClassedRay(const Ray& ray)
      : origin(ray.origin),
        direction(ray.direction),
        signs(static_cast<unsigned>(std::signbit(ray.direction.x)) |
              static_cast<unsigned>(std::signbit(ray.direction.y)) << 1U |
              static_cast<unsigned>(std::signbit(ray.direction.z)) << 2U) {}
};

}  // namespace hitpipe::thesis
