// The Pluecker box test of section 3.3 for infinite rays: "plu" moves the box to the ray's origin; "plu-cff"
// uses the ray's coordinates R0, R1, R3 instead. Forms with a distance give the distance of the last of the
// three planes that face the ray, 0 if the origin is inside (figure 3.6).
#pragma once

#include <glm/vec3.hpp>

#include "rays/mesh/aabb.hpp"
#include "thesis/plane_distance.hpp"
#include "thesis/ray_class.hpp"
#include "thesis/reference.hpp"

namespace hitpipe::thesis {

/// Whether the box lies behind the ray's origin on some axis.
template <class Class, class T>
bool behind(const BasicAabb<T>& box, const glm::vec<3, T>& origin) {
  const auto beyond = [](bool minus, T plane, T from) { return minus ? from < plane : from > plane; };
  const glm::vec<3, T> exit = Class::exit(box);
  return beyond(Class::minus(0), exit.x, origin.x) || beyond(Class::minus(1), exit.y, origin.y) ||
         beyond(Class::minus(2), exit.z, origin.z);
}

/// Distance to a box that is hit.
template <class Class, class Ray, class T>
T entry_distance(const Ray& ray, const BasicAabb<T>& box) {
  const glm::vec<3, T> t = ray.along(Class::entry(box));
  T distance = 0;
  keep_larger(distance, t.x);
  keep_larger(distance, t.y);
  keep_larger(distance, t.z);
  return distance;
}

/// The numbers of one axis that enter the side relations with edges parallel to another axis.
template <class T>
struct EdgeAxis {
  T direction, min, max;  ///< of ray and box
};

/// Whether the ray passes outside one of the two silhouette edges parallel to the third axis. The sign of a
/// direction component alone decides which plane it is multiplied by. `moment` is the term that makes up for
/// not moving the box to the ray's origin.
template <bool minus_i, bool minus_j, class T>
bool outside(const EdgeAxis<T>& i, const EdgeAxis<T>& j, T moment) {
  return j.direction * (minus_j ? i.min : i.max) - i.direction * (minus_i ? j.max : j.min) < moment ||
         i.direction * (minus_i ? j.min : j.max) - j.direction * (minus_j ? i.max : i.min) < -moment;
}

/// The same for all six edges.
template <class Class, class T>
bool outside_silhouette(const glm::vec<3, T>& direction, const BasicAabb<T>& box, T moment_xy, T moment_zx,
                        T moment_yz) {
  const EdgeAxis<T> x{direction.x, box.min.x, box.max.x};
  const EdgeAxis<T> y{direction.y, box.min.y, box.max.y};
  const EdgeAxis<T> z{direction.z, box.min.z, box.max.z};
  return outside<Class::minus(0), Class::minus(1)>(x, y, moment_xy) ||
         outside<Class::minus(2), Class::minus(0)>(z, x, moment_zx) ||
         outside<Class::minus(1), Class::minus(2)>(y, z, moment_yz);
}

/// "plu", and "plu-int-div", "plu-int-mul" with a distance.
template <class T, Distance distance>
struct Plu {
  static constexpr bool has_distance = distance != Distance::none;
  using Ray = DistanceRay<T, distance>;

  static bool test(const Ray& ray, const BasicAabb<T>& box, T& entry) {
    return with_ray_class(ray.signs, [&](auto ray_class) {
      using Class = decltype(ray_class);
      if (behind<Class>(box, ray.origin)) return false;
      const BasicAabb<T> moved{box.min - ray.origin, box.max - ray.origin};
      if (outside_silhouette<Class>(ray.direction, moved, T(0), T(0), T(0))) return false;
      if constexpr (has_distance) entry = entry_distance<Class>(ray, box);
      return true;
    });
  }
};

/// "plu-cff", "plu-cff-int-div", "plu-cff-int-mul".
template <class T, Distance distance>
struct PluCff {
  static constexpr bool has_distance = distance != Distance::none;

  struct Ray : DistanceRay<T, distance> {
    /// o_i d_j - d_i o_j: R0 for xy, -R1 for zx, R3 for yz (section 3.2).
    T xy, zx, yz;

    explicit Ray(const ref::Ray& ray)
        : DistanceRay<T, distance>(ray), xy(moment(0, 1)), zx(moment(2, 0)), yz(moment(1, 2)) {}

   private:
    [[nodiscard]] T moment(int i, int j) const {
      return this->origin[i] * this->direction[j] - this->direction[i] * this->origin[j];
    }
  };

  static bool test(const Ray& ray, const BasicAabb<T>& box, T& entry) {
    return with_ray_class(ray.signs, [&](auto ray_class) {
      using Class = decltype(ray_class);
      if (behind<Class>(box, ray.origin)) return false;
      if (outside_silhouette<Class>(ray.direction, box, ray.xy, ray.zx, ray.yz)) return false;
      if constexpr (has_distance) entry = entry_distance<Class>(ray, box);
      return true;
    });
  }
};

}  // namespace hitpipe::thesis
