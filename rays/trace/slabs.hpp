// The slabs box test (section 2.3.1), set up once per ray.
//   Slabs<T>     as the thesis computes it, in binary32 or binary64: rounding makes it miss boxes that a ray
//                only grazes, but never the triangles in a padded box
//   ConservativeSlabs  binary32 widened by a proven bound: never misses a closed box that the exact ray meets
// Both take a ray and boxes of the [-1, 1] cube, and the length at which the ray is cut, >= 0 or infinite.
#pragma once

#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include "rays/mesh/aabb.hpp"
#include "rays/mesh/ray.hpp"
#include "rays/trace/lanes.hpp"
#include "rays/trace/mirror.hpp"

namespace hitpipe::ref {

/// The distances at which a ray enters and leaves the slabs. The fourth lanes are 0 and the ray's length.
template <class T>
struct SlabDistances {
  Lanes<T> near, far;

  /// True if no distance of entry is above one of exit. A NaN is above nothing, so its slab is no constraint.
  [[nodiscard]] bool overlap() const {
    const Lanes<T> far_1 = rotated(far);
    return !any((near > far) | (near > far_1) | (near > rotated_twice(far)) | (near > rotated_twice(far_1)));
  }
  /// The distance at which the ray enters the box.
  [[nodiscard]] T entry() const {
    T last = near[3];
    for (std::size_t axis = 0; axis < 3; ++axis) last = near[axis] > last ? near[axis] : last;
    return last;
  }
};

/// The IRDVC, >= 0. 1/0 is infinite, and infinity times 0 is NaN. In binary32 a component that is neither 0
/// nor in [2^-100, 2^100] gets NaN, so its slab is no constraint. In binary64 no inverse leaves the range.
template <class T>
[[nodiscard]] T slab_inverse(float d) {
  const float size = std::fabs(d);
  const bool bounded = sizeof(T) > sizeof(float) || size == 0.0F || (size >= 0x1p-100F && size <= 0x1p100F);
  return bounded ? T(1) / T(size) : std::numeric_limits<T>::quiet_NaN();
}

/// The mirrored ray that both tests use.
template <class T>
class SlabRay {
 public:
  explicit SlabRay(const Ray& ray)
      : mirror_(ray.direction),
        irdvc_(slab_inverse<T>(ray.direction.x), slab_inverse<T>(ray.direction.y),
               slab_inverse<T>(ray.direction.z), 0) {
    const glm::vec3 origin = mirror_(ray.origin);
    origin_ = {origin.x, origin.y, origin.z, 0};
    cut(ray.length);
  }

  [[nodiscard]] const Mirror& mirror() const { return mirror_; }

  /// An infinite length is cut to the largest finite number, because infinity times 0 (the box's fourth lane)
  /// is NaN.
  void cut(float length) {
    constexpr T longest = std::numeric_limits<T>::max();
    irdvc_.set(3, length < longest ? length : longest);
  }

  template <class U>
  [[nodiscard]] SlabDistances<T> distances(const MirroredBox<U>& box) const {
    return {(Lanes<T>(box.near) - origin_) * irdvc_, (Lanes<T>(box.far) - origin_) * irdvc_};
  }

 private:
  Mirror mirror_;
  Lanes<T> origin_;
  Lanes<T> irdvc_;  ///< and the length
};

/// Multiplies by IRDVCs. On boxes padded by 5e-7 it never misses a triangle. Proof: let the exact ray meet a
/// triangle of the unpadded box at t*. In the cube |x - o| < 2 + 10^-6, and a distance has three roundings
/// (difference, inverse, product), so it errs by less than 3.6e-7 / |d|. Underflow adds 2^-150, which is
/// negligible against 1e-8 / |d| for |d| <= 2^100. A padded face, rounded to binary32, lies at least 5e-7 -
/// 3e-8 outside the unpadded one, so its distance differs by at least 4.7e-7 / |d|. So every computed near is
/// below t* and every computed far above it, and with length >= t* the box is a hit. A zero d compares
/// exactly. The proof does not cover smaller paddings; use ConservativeSlabs for those.
template <class T>
class Slabs {
 public:
  using Distance = T;

  explicit Slabs(const Ray& ray) : ray_(ray) {}

  void cut(float length) { ray_.cut(length); }
  [[nodiscard]] const Mirror& mirror() const { return ray_.mirror(); }

  template <class U>
  [[nodiscard]] bool operator()(const BasicAabb<U>& box) const {
    return meets(mirror()(box));
  }
  template <class U>
  [[nodiscard]] bool meets(const MirroredBox<U>& box) const {
    return ray_.distances(box).overlap();
  }
  /// Also gives the distance at which the ray enters the box, for the order of children.
  template <class U>
  [[nodiscard]] bool enters(const BasicAabb<U>& box, T& distance) const {
    const SlabDistances<T> t = ray_.distances(mirror()(box));
    distance = t.entry();
    return t.overlap();
  }

 private:
  SlabRay<T> ray_;
};

/// Conservative: false only when no exact point origin + t * direction, 0 <= t <= length, lies in the closed
/// box. Coordinates of box and origin must not exceed 2^25 in magnitude.
class ConservativeSlabs {
 public:
  using Distance = float;

  explicit ConservativeSlabs(const Ray& ray) : ray_(ray) {}

  void cut(float length) { ray_.cut(length); }
  [[nodiscard]] const Mirror& mirror() const { return ray_.mirror(); }

  [[nodiscard]] bool operator()(const Aabb& box) const { return meets(mirror()(box)); }
  [[nodiscard]] bool meets(const MirroredBox<float>& box) const { return widened(box).overlap(); }
  /// Also gives a distance that is not above that at which the ray enters the box.
  [[nodiscard]] bool enters(const Aabb& box, float& distance) const {
    const SlabDistances<float> t = widened(mirror()(box));
    distance = t.entry();
    return t.overlap();
  }

 private:
  /// Let u = 2^-24. For 2^-100 <= |d| <= 2^100 the exact distance t = (x - o) / d is computed with three
  /// roundings (difference, inverse, product). A difference of floats never underflows inexactly. |x - o| <=
  /// 2^26 and the inverse lies in [2^-100, 2^100], so nothing overflows and only the product can underflow:
  ///     |computed - t| <= g |t| + e,   g = (1 + u)^3 - 1 < 4 u,   e = 2^-150,
  /// and computed has the sign of t or is 0.
  /// Let the exact ray be in the box at t*, 0 <= t* <= length. Then each exact near <= t* <= each exact far, so
  ///     computed near <= t* (1 + g) + e,
  ///     computed far  >= t* (1 - g) - e     (t* >= 0, so it is not computed as negative).
  /// With c = 16 u: the product near (1 - c) is rounded once, to at most (t* (1 + g) + e)(1 - c)(1 + u) + e,
  /// and (1 + g)(1 - c)(1 + u) < 1, so subtracting 2^-126 > 4 e leaves an exact value below t*; a negative
  /// near stays negative. Likewise far (1 + c), rounded, plus 2^-126 is an exact value above t*. The last
  /// rounding is monotone: exact near' <= t* <= far' gives rounded near' <= rounded far', and near' <= t* <=
  /// length with length a float gives rounded near' <= length. The fourth lanes, 0 and length, are not
  /// widened: 0 <= length, and 0 <= t* <= far'. (A fused multiply-add has one rounding fewer; the proof still
  /// holds.) A zero d gives an infinite inverse. Both distances are then infinite with the sign of the side,
  /// which is exact, or NaN if o lies in the face, and then the slab is no constraint. Cutting an infinite
  /// length to the largest finite float makes near = +infinity a miss; no finite near exceeds 2^127. For any
  /// other d the slab is no constraint.
  [[nodiscard]] SlabDistances<float> widened(const MirroredBox<float>& box) const {
    constexpr float c = 0x1p-20F;
    constexpr float least = std::numeric_limits<float>::min();
    const Lanes<float> less(1 - c, 1 - c, 1 - c, 1);
    const Lanes<float> more(1 + c, 1 + c, 1 + c, 1);
    const Lanes<float> tiny(least, least, least, 0);
    SlabDistances<float> t = ray_.distances(box);
    t.near = t.near * less - tiny;
    t.far = t.far * more + tiny;
    return t;
  }

  SlabRay<float> ray_;
};

}  // namespace hitpipe::ref
