// The Pluecker box test (Plu-AABB, section 3.3), set up once per ray. It asks whether the ray passes inside
// the six edges of the box's silhouette, and whether the box lies between the ends of the ray. It has no
// division. On boxes padded by 5e-7 it never misses a triangle; like Slabs it can miss a box that a ray only
// grazes.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include <glm/vec3.hpp>

#include "rays/mesh/aabb.hpp"
#include "rays/mesh/ray.hpp"
#include "rays/trace/lanes.hpp"
#include "rays/trace/mirror.hpp"

namespace hitpipe::ref {

/// The direction, scaled by a power of two so that products of its components with coordinates do not
/// underflow. The largest component ends in [2^-23, 4), and a component below 2^-60 of it becomes 0. Inside
/// the cube that moves a point of the ray by less than 2^-58.
[[nodiscard]] inline glm::vec3 unstiffened(const glm::vec3& d) {
  const float largest = std::max(std::max(std::fabs(d.x), std::fabs(d.y)), std::fabs(d.z));
  const std::uint32_t exponent = std::bit_cast<std::uint32_t>(largest) >> 23U;
  const auto scale = std::bit_cast<float>((254U - std::clamp(exponent, 1U, 253U)) << 23U);
  const float least = largest * scale * 0x1p-60F;
  const auto scaled = [&](float x) {
    return std::fabs(x) * scale < least ? std::copysign(0.0F, x) : x * scale;
  };
  return {scaled(d.x), scaled(d.y), scaled(d.z)};
}

/// Everything is mirrored so that the direction d is (+, +, +). Let n and f be a box's near and far planes
/// minus the origin. The ray passes the silhouette edge between near face i and far face j on the inner side
/// if d_j n_i <= d_i f_j. The box is ahead of the origin if f >= 0, and the ray reaches it if n <= length d.
///
/// Rounding. Let the exact ray meet the unpadded box. Padding moves n and f outward by at least 4.7e-7 each,
/// so d_i f_j - d_j n_i >= 4.7e-7 (d_i + d_j). Each product has two roundings (difference, product) and |x -
/// o| < 2 + 10^-6, so the products err by 2.4e-7 (d_i + d_j), and the sign of their difference is exact.
/// Underflow and the dropped components of unstiffened() are far smaller. The proof does not cover smaller
/// paddings.
template <class T>
class Plucker {
 public:
  explicit Plucker(const Ray& ray) : mirror_(ray.direction), given_(ray.direction) {
    const glm::vec3 origin = mirror_(ray.origin);
    const glm::vec3 direction = mirror_(steady(ray.direction));
    origin_ = {origin.x, origin.y, origin.z, 0};
    direction_ = {direction.x, direction.y, direction.z, 0};
    cut(ray.length);
  }

  /// Keeps the end of the ray minus its origin, mirrored and rounded outward. The product of binary32 values
  /// is exact in binary64. The factor 1 + 2^-22 covers its rounding to T and the rounding of the plane's
  /// difference; the addend covers underflow. No plane is beyond an infinite end.
  void cut(float length) {
    constexpr double largest{std::numeric_limits<float>::max()};
    constexpr double least{std::numeric_limits<float>::min()};
    const auto reach = [&](float d) {
      const double rounded = double{length} * std::fabs(double{d}) * (1 + 0x1p-22) + least;
      return rounded < largest ? static_cast<T>(rounded) : std::numeric_limits<T>::infinity();
    };
    end_ = {reach(given_.x), reach(given_.y), reach(given_.z), 0};
  }

  [[nodiscard]] const Mirror& mirror() const { return mirror_; }

  template <class U>
  [[nodiscard]] bool operator()(const BasicAabb<U>& box) const {
    return meets(mirror_(box));
  }
  template <class U>
  [[nodiscard]] bool meets(const MirroredBox<U>& box) const {
    const Lanes<T> n = Lanes<T>(box.near) - origin_;
    const Lanes<T> f = Lanes<T>(box.far) - origin_;
    const Lanes<T> next_direction = next_axis(direction_);
    const LaneMask<T> outside =
        (next_direction * n > direction_ * next_axis(f)) | (direction_ * next_axis(n) > next_direction * f);
    const LaneMask<T> behind = Lanes<T>(0, 0, 0, 0) > f;
    const LaneMask<T> beyond = n > end_;
    return !any(outside | behind | beyond);
  }

 private:
  static glm::vec3 steady(const glm::vec3& direction) {
    // Products of two binary32 do not underflow in binary64.
    return sizeof(T) > sizeof(float) ? direction : unstiffened(direction);
  }

  Mirror mirror_;
  Lanes<T> origin_;
  Lanes<T> direction_;
  Lanes<T> end_;
  glm::vec3 given_;
};

}  // namespace hitpipe::ref
