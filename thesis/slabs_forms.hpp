// The slabs test of section 2.3.1 in the forms that chapter 3 times, for infinite rays: "slabs" selects near
// and far planes by the signs of the direction at run time; "slabs8" knows them in each of the eight ray
// classes. The distance is where the ray enters, 0 if the origin is inside.
#pragma once

#include <cmath>
#include <limits>
#include <utility>

#include "rays/mesh/aabb.hpp"
#include "thesis/plane_distance.hpp"
#include "thesis/ray_class.hpp"
#include "thesis/reference.hpp"

namespace hitpipe::thesis {

/// Whether the intervals of the three slabs, from entry to exit, have a common point that is not behind the
/// origin. They are intersected one after the other, until nothing is left.
template <class T>
bool intervals_overlap(const glm::vec<3, T>& first, const glm::vec<3, T>& last, T& entry) {
  T near = 0;
  T far = std::numeric_limits<T>::infinity();
  const auto cut = [&](T from, T to) {
    keep_larger(near, from);
    keep_smaller(far, to);
    return near <= far;
  };
  if (!cut(first.x, last.x) || !cut(first.y, last.y) || !cut(first.z, last.z)) return false;
  entry = near;
  return true;
}

/// "slabs-div", "slabs-mul".
template <class T, Distance distance>
struct SlabsForm {
  static constexpr bool has_distance = true;
  using Ray = DistanceRay<T, distance>;

  static bool test(const Ray& ray, const BasicAabb<T>& box, T& entry) {
    glm::vec<3, T> first = ray.along(box.min);
    glm::vec<3, T> last = ray.along(box.max);
    if (std::signbit(ray.direction.x)) std::swap(first.x, last.x);
    if (std::signbit(ray.direction.y)) std::swap(first.y, last.y);
    if (std::signbit(ray.direction.z)) std::swap(first.z, last.z);
    return intervals_overlap(first, last, entry);
  }
};

/// "slabs8-div", "slabs8-mul".
template <class T, Distance distance>
struct Slabs8 {
  static constexpr bool has_distance = true;
  using Ray = DistanceRay<T, distance>;

  static bool test(const Ray& ray, const BasicAabb<T>& box, T& entry) {
    return with_ray_class(ray.signs, [&](auto ray_class) {
      using Class = decltype(ray_class);
      return intervals_overlap(ray.along(Class::entry(box)), ray.along(Class::exit(box)), entry);
    });
  }
};

}  // namespace hitpipe::thesis
