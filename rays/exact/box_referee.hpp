// The exact ray-box referee: does { origin + t * direction : 0 <= t <= length } meet the closed box? It
// judges the binary32 values as given, without any rounding. A direction component of +-0 is exactly zero:
// the ray is parallel to that slab. An integer unit may hit where the referee says no; it must never miss
// where the referee says yes (sections 6.2, 6.3).
#pragma once

#include <array>
#include <optional>
#include <span>

#include <glm/vec3.hpp>

#include "rays/mesh/aabb.hpp"
#include "rays/mesh/ray.hpp"

namespace hitpipe::ref {

/// Origin in [-1, 1]^3, direction finite and not all zero, length >= 0 or infinite. Callers count the rays
/// that are refused.
[[nodiscard]] bool acceptable(const Ray& ray);

/// Finite, min <= max on each axis, within [-1, 1]^3.
[[nodiscard]] bool acceptable(const Aabb& box);

/// A ray prepared for judging many boxes.
class BoxReferee {
 public:
  explicit BoxReferee(const Ray& ray);
  /// As ray_meets_box().
  [[nodiscard]] bool meets(const Aabb& box) const;
  /// The same for each of the boxes.
  void meet(std::span<const Aabb> boxes, std::span<bool> out) const;
  /// As ray_meets_box_filtered().
  [[nodiscard]] std::optional<bool> filtered(const Aabb& box) const;

 private:
  /// Neither: in doubt.
  struct Verdict {
    bool met, missed;
  };
  [[nodiscard]] Verdict judged(const Aabb& box) const;

  Ray ray_;
  glm::dvec3 origin_;
  glm::dvec3 inverse_{0};
  double length_;
  std::array<unsigned, 3> near_face_{};  ///< as Aabb::plane counts
};

/// The exact answer for an acceptable ray and box. A filter in double answers first; in doubt, sums and
/// products of doubles with their rounding errors decide.
[[nodiscard]] bool ray_meets_box(const Ray& ray, const Aabb& box);

/// The same answer from integers alone. It judges the other forms and is about a hundred times slower.
[[nodiscard]] bool ray_meets_box_exact(const Ray& ray, const Aabb& box);

/// The exact answer from sums and products of doubles and their rounding errors, without the filter.
[[nodiscard]] bool ray_meets_box_by_products(const Ray& ray, const Aabb& box);

/// The filter alone: the exact answer, or nothing if double precision cannot decide.
[[nodiscard]] std::optional<bool> ray_meets_box_filtered(const Ray& ray, const Aabb& box);

}  // namespace hitpipe::ref
