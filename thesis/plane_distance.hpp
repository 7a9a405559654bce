// Distances along a ray to a plane (section 2.3.1), by division or by inverse ray direction vector components
// (IRDVCs) that the ray carries. A ray that lies in the plane has the distance 0/0, which is NaN.
// keep_larger() and keep_smaller() ignore NaN, so that plane is no constraint.
#pragma once

#include <glm/vec3.hpp>

#include "thesis/ray_class.hpp"

namespace hitpipe::thesis {

enum class Distance {
  none,      ///< hit or miss only
  divide,    ///< "div"
  multiply,  ///< "mul"
};

template <class T, Distance distance>
struct DistanceRay : ClassedRay<T> {
  using ClassedRay<T>::ClassedRay;
  /// To the planes at these coordinates.
  [[nodiscard]] glm::vec<3, T> along(const glm::vec<3, T>& planes) const {
    return (planes - this->origin) / this->direction;
  }
};

template <class T>
struct DistanceRay<T, Distance::multiply> : ClassedRay<T> {
  glm::vec<3, T> irdvc;

  explicit DistanceRay(const Ray& ray) : ClassedRay<T>(ray), irdvc(T(1) / this->direction) {}
  [[nodiscard]] glm::vec<3, T> along(const glm::vec<3, T>& planes) const {
    return (planes - this->origin) * irdvc;
  }
};

template <class T>
void keep_larger(T& kept, T t) {
  kept = t > kept ? t : kept;
}
template <class T>
void keep_smaller(T& kept, T t) {
  kept = t < kept ? t : kept;
}

}  // namespace hitpipe::thesis
