#include "rays/exact/float_crossing.hpp"

#include <array>
#include <cstddef>

#include <glm/geometric.hpp>

#include "rays/exact/major_quotient.hpp"
#include "rays/exact/passage.hpp"

namespace hitpipe::ref {
namespace {

int sign_of(const WideInt& x) {
  return x.sign();
}

/// On which side of the moved ray is an edge that passes it at 0? With corners j and k seen from the origin, the
/// determinant of the edge is e = D . (j x k), and a move of the origin by d adds d . (D x (k - j)) to it. Both
/// components are 0 only if the edge is parallel to the ray; then the triangle is, too.
int side_after_move(const Ray& ray, const glm::vec3& from, const glm::vec3& to) {
  const WideVec change = cross(in_units(ray.direction), difference(in_units(to), in_units(from)));
  const int major = major_axis(ray.direction);
  const int along_a = sign_of(change[major == 1 ? 0 : 1]);
  return along_a != 0 ? along_a : sign_of(change[major == 2 ? 0 : 2]);
}

/// The sign of a determinant that enclose() has found to be far from 0.
int side_by_doubles(const Mesh::Corners& corners, const Ray& ray) {
  const glm::dvec3 a(corners.a);
  const glm::dvec3 normal = glm::cross(glm::dvec3(corners.b) - a, glm::dvec3(corners.c) - a);
  return glm::dot(glm::dvec3(ray.direction), normal) > 0 ? 1 : -1;
}

}  // namespace

std::optional<FloatCrossing> float_crossing(const Mesh::Corners& corners, const Ray& ray) {
  using triangle_filter::Verdict;
  FloatCrossing found{.once = true};
  const Verdict verdict = triangle_filter::classify(corners, ray, found.t);
  if (verdict == Verdict::miss) return std::nullopt;
  const double length = ray.length;
  if (verdict == Verdict::hit && found.t.low > length) return std::nullopt;
  if (verdict == Verdict::hit && found.t.high <= length) {
    found.side = side_by_doubles(corners, ray);
    return found;
  }
  if (!triangle_filter::enclose_exactly(corners, ray, found.t)) return std::nullopt;
  const Passage passage(corners, ray);
  found.side = sign_of(passage.determinant());
  const std::array corner{corners.a, corners.b, corners.c};
  for (std::size_t i = 0; i < 3; ++i) {
    if (passage.edges[i] != 0) continue;
    found.tie = true;
    if (side_after_move(ray, corner[(i + 1) % 3], corner[(i + 2) % 3]) != found.side) found.once = false;
  }
  return found;
}

}  // namespace hitpipe::ref
