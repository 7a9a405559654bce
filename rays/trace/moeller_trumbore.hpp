// The two-sided ray-triangle test of Moeller and Trumbore (1997), in binary32 or binary64, which the thesis
// times. Because of rounding it accepts some points outside the triangle and loses some on shared edges. The
// exact test is rays/exact/triangle_test.hpp.
#pragma once

#include <cmath>
#include <cstdint>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "rays/exact/triangle_test.hpp"
#include "rays/mesh/mesh.hpp"
#include "rays/mesh/ray.hpp"

namespace hitpipe::ref {

/// One triangle, loaded and set up for any number of rays.
template <class T>
class MoellerTrumbore {
 public:
  MoellerTrumbore(const Mesh& mesh, std::uint32_t triangle) : index_(triangle) {
    const Mesh::Corners corners = mesh.corners(triangle);
    a_ = Vec(corners.a);
    side_b_ = Vec(corners.b) - a_;
    side_c_ = Vec(corners.c) - a_;
  }

  /// Keeps the hit with 0 <= t <= length if t is less than the best so far, or equal with a lower index. In
  /// `best` both bounds of t are the computed t. The division comes after the point is known to be inside.
  /// Each condition is written as the negation of what must hold, so that a NaN is refused.
  bool operator()(const Ray& ray, Hit& best) const {
    const Vec direction(ray.direction);
    const Vec p = glm::cross(direction, side_c_);
    const T determinant = glm::dot(side_b_, p);
    const T size = std::fabs(determinant);
    const T side = std::copysign(T(1), determinant);
    const Vec from_a = Vec(ray.origin) - a_;
    const T u = glm::dot(from_a, p) * side;
    if (!(u >= 0 && u <= size)) return false;
    const Vec q = glm::cross(from_a, side_b_);
    const T v = glm::dot(direction, q) * side;
    if (!(v >= 0 && u + v <= size && size > 0)) return false;
    const T t = glm::dot(side_c_, q) / determinant;
    if (!(t >= 0 && t <= T(ray.length))) return false;
    const double distance{t};
    if (!(distance < best.t_low || (distance == best.t_low && index_ < best.triangle))) return false;
    best = {index_, distance, distance};
    return true;
  }

 private:
  using Vec = glm::vec<3, T>;

  Vec a_, side_b_, side_c_;
  std::uint32_t index_;
};

}  // namespace hitpipe::ref
