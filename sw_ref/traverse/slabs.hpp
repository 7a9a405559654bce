// The slabs box test in binary32 (section 2.3.1), set up once per ray.
//   FloatSlabs   as the thesis computes it: fast, but rounding makes it miss boxes that a ray only grazes
//   RobustSlabs  widened by a proven bound: never misses a closed box that the exact ray meets
// Both take ray and box of the [-1, 1] cube, and the length at which the ray is cut, >= 0 or infinite.
#pragma once

#include <cmath>
#include <limits>

#include <glm/vec3.hpp>

#include "sw_ref/geometry/aabb.hpp"
#include "sw_ref/geometry/ray.hpp"

namespace hitpipe::ref {

/// The faces through which a ray of a given direction enters and leaves the three slabs, as numbers of
/// Aabb::plane.
struct SlabFaces {
  unsigned near_x, near_y, near_z;
  unsigned far_x, far_y, far_z;

  explicit SlabFaces(const glm::vec3& direction)
      : near_x(std::signbit(direction.x) ? 3 : 0),
        near_y(std::signbit(direction.y) ? 4 : 1),
        near_z(std::signbit(direction.z) ? 5 : 2),
        far_x(3 - near_x),
        far_y(5 - near_y),
        far_z(7 - near_z) {}
};

/// [near, far] of the slabs, cut to [0, length]. A distance that is NaN compares false and changes nothing:
/// that slab is no constraint.
struct SlabInterval {
  float near;
  float far;

  SlabInterval(const Aabb& box, const SlabFaces& faces, const glm::vec3& origin, const glm::vec3& irdvc,
               float length)
      : near(0.0F), far(length) {
    raise(near, (box.plane(faces.near_x) - origin.x) * irdvc.x);
    lower(far, (box.plane(faces.far_x) - origin.x) * irdvc.x);
    raise(near, (box.plane(faces.near_y) - origin.y) * irdvc.y);
    lower(far, (box.plane(faces.far_y) - origin.y) * irdvc.y);
    raise(near, (box.plane(faces.near_z) - origin.z) * irdvc.z);
    lower(far, (box.plane(faces.far_z) - origin.z) * irdvc.z);
  }

 private:
  // Written so that a compiler needs one maxss or minss: the kept value is the second operand, also beside a
  // NaN.
  static void raise(float& kept, float t) { kept = t > kept ? t : kept; }
  static void lower(float& kept, float t) { kept = t < kept ? t : kept; }
};

/// Multiplies by IRDVCs; 1/0 is infinite and 0 times infinite is NaN, which is ignored.
class FloatSlabs {
 public:
  explicit FloatSlabs(const Ray& ray)
      : origin_(ray.origin), irdvc_(1.0F / ray.direction), faces_(ray.direction) {}

  [[nodiscard]] bool operator()(const Aabb& box, float length) const {
    const SlabInterval t(box, faces_, origin_, irdvc_, length);
    return t.near <= t.far;
  }

 private:
  glm::vec3 origin_;
  glm::vec3 irdvc_;
  SlabFaces faces_;
};

/// Conservative: false only when no exact point origin + t * direction, 0 <= t <= length, lies in the closed
/// box. Coordinates of box and origin must not exceed 2 in magnitude.
class RobustSlabs {
 public:
  explicit RobustSlabs(const Ray& ray)
      : origin_(ray.origin),
        irdvc_(safe_inverse(ray.direction.x), safe_inverse(ray.direction.y), safe_inverse(ray.direction.z)),
        faces_(ray.direction) {}

  /// Let u = 2^-24. For 2^-100 <= |d| <= 2^100 the exact distance t = (x - o) / d is computed with three
  /// roundings (difference, inverse, product). A difference of floats never underflows inexactly, |x - o| <=
  /// 4 and the inverse lies in [2^-100, 2^100], so nothing overflows and only the product can underflow:
  ///     |computed - t| <= g |t| + e,   g = (1 + u)^3 - 1 < 4 u,   e = 2^-150,   and computed has the sign of
  ///     t or is 0.
  /// Let the exact ray be in the box at t*, 0 <= t* <= length. Then each exact near <= t* <= each exact far,
  /// hence
  ///     computed near <= t* (1 + g) + e     (the same holds for the 0 that near starts from),
  ///     computed far  >= t* (1 - g) - e     (far >= 0, so it is not computed as negative).
  /// With c = 16 u: the product near (1 - c) is rounded once, to at most (t* (1 + g) + e)(1 - c)(1 + u) + e,
  /// and (1 + g)(1 - c)(1 + u) < 1, so subtracting 2^-126 > 4 e leaves an exact value below t*. Likewise far
  /// (1 + c), rounded, plus 2^-126 is an exact value above t*. The last rounding is monotone: exact near' <=
  /// t* <= far' gives rounded near' <= rounded far', and near' <= t* <= length with length a float gives
  /// rounded near' <= length. (A fused multiply-add has one rounding fewer; the argument stands.) A zero d
  /// gives an infinite inverse: both distances are infinite with the side's sign, which is exact, or NaN when
  /// o lies in the face, where the slab is no constraint either. Cutting an infinite length to the largest
  /// finite float makes near = +infinity a miss; no finite near exceeds 2^103. Any other d makes its slab no
  /// constraint.
  [[nodiscard]] bool operator()(const Aabb& box, float length) const {
    constexpr float c = 0x1p-20F;
    constexpr float tiny = std::numeric_limits<float>::min();
    constexpr float longest = std::numeric_limits<float>::max();
    const float cut = length < longest ? length : longest;
    const SlabInterval t(box, faces_, origin_, irdvc_, std::numeric_limits<float>::infinity());
    const float near = t.near * (1.0F - c) - tiny;
    const float far = t.far * (1.0F + c) + tiny;
    return near <= (far < cut ? far : cut);
  }

 private:
  static float safe_inverse(float d) {
    const float size = std::fabs(d);
    const bool bounded = size == 0.0F || (size >= 0x1p-100F && size <= 0x1p100F);
    return bounded ? 1.0F / d : std::numeric_limits<float>::quiet_NaN();
  }

  glm::vec3 origin_;
  glm::vec3 irdvc_;
  SlabFaces faces_;
};

}  // namespace hitpipe::ref
