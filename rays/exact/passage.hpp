// A line and a triangle in the integers of the slow exact path. Only .cpp files of rays/exact include this.
#pragma once

#include <array>

#include "rays/exact/wide_int.hpp"
#include "rays/mesh/mesh.hpp"
#include "rays/mesh/ray.hpp"

namespace hitpipe::ref {

/// How a line passes a triangle.
struct Passage {
  WideVec a, b_cross_c;          ///< seen from the ray's origin
  std::array<WideInt, 3> edges;  ///< on which side it passes the edge opposite each corner

  Passage(const Mesh::Corners& corners, const Ray& ray) {
    const WideVec origin = in_units(ray.origin);
    const WideVec direction = in_units(ray.direction);
    a = difference(in_units(corners.a), origin);
    const WideVec b = difference(in_units(corners.b), origin);
    const WideVec c = difference(in_units(corners.c), origin);
    b_cross_c = cross(b, c);
    edges = {dot(direction, b_cross_c), dot(direction, cross(c, a)), dot(direction, cross(a, b))};
  }
  /// b x c + c x a + a x b is the normal (b - a) x (c - a), so the sum is direction . normal.
  [[nodiscard]] WideInt determinant() const { return edges[0] + edges[1] + edges[2]; }
  /// a . normal
  [[nodiscard]] WideInt height() const { return dot(a, b_cross_c); }
};

}  // namespace hitpipe::ref
