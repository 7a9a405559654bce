// The exact ray-triangle test: one answer for every traversal, whatever order it visits triangles in. A ray
// hits the closed triangle from either side when the exact parameter t of its line in the triangle's plane
// has 0 <= t <= length and the point lies in the triangle; a ray parallel to the plane (determinant 0) never
// hits. The smaller exact t wins; exact ties go to the lower index. Signs of triple products decide, as in
// Pluecker tests (section 2.2), so triangles that share an edge leave no gap. A filter in double, with proven
// bounds after Shewchuk (1997), answers nearly always; integers answer the rest.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "rays/mesh/mesh.hpp"
#include "rays/mesh/ray.hpp"

#ifdef __FAST_MATH__
#error "the error bounds of rays/exact need IEEE arithmetic: build without -ffast-math"
#endif

namespace hitpipe::ref {

/// The closest hit so far. [t_low, t_high] contains the exact t and depends only on ray and triangle.
struct Hit {
  static constexpr std::uint32_t none = ~0U;

  std::uint32_t triangle = none;
  double t_low = std::numeric_limits<double>::infinity();   ///< in units of the ray's direction
  double t_high = std::numeric_limits<double>::infinity();  ///< >= t_low

  [[nodiscard]] bool found() const { return triangle != none; }
};

/// Tests one triangle against an acceptable ray and keeps the better hit in `best`. `best` must come from the
/// same mesh and ray. True if `best` changed. Corners and ray are finite binary32 values.
bool intersect_triangle(const Mesh& mesh, std::uint32_t triangle, const Ray& ray, Hit& best);
/// The same with the triangle's corners at hand.
bool intersect_triangle(const Mesh& mesh, std::uint32_t triangle, const Mesh::Corners& corners,
                        const Ray& ray, Hit& best);

/// Where the line of a ray meets the plane of a triangle, in exact arithmetic. Each number is then a
/// neighbouring double towards 0, or itself. No weight is negative if the point lies in the triangle.
struct PlanePoint {
  double t;
  std::array<double, 3> weights;  ///< of the corners
};
/// Nothing when the line is parallel to the plane.
[[nodiscard]] std::optional<PlanePoint> plane_point(const Mesh::Corners& corners, const Ray& ray);
/// PlanePoint::t alone, which takes less time.
[[nodiscard]] std::optional<double> plane_distance(const Mesh::Corners& corners, const Ray& ray);

/// A ray length for culling boxes: binary32, never below the exact t; infinite without a hit.
[[nodiscard]] float cull_length(const Hit& hit);

/// Whether the corners, finite binary32 values, span a triangle: false if they are exactly collinear or
/// equal.
[[nodiscard]] bool has_area(const Mesh::Corners& corners);
/// The same of finite binary64 values below 2^128 in magnitude.
[[nodiscard]] bool has_area(const SourceMesh::Corners& corners);

namespace triangle_filter {

/// u, the largest relative error of one double operation. Nothing here overflows or underflows: differences
/// of binary32 values are multiples of 2^-149 below 2^129 (and stay so when rounded), hence every sum of
/// triple products is a multiple of 2^-447 below 2^390.
constexpr double unit_roundoff = 0x1p-53;

/// Error bound of a triple product with one exact row and two rows of rounded differences. Each of its six
/// terms has 7 roundings: 2 of entries, 1 of the inner product, 1 of the minor, 1 of the outer product and 2
/// of the sum. So the error is at most ((1 + u)^7 - 1) * (sum of |terms|), and that sum at most 2 |row 1|_1
/// |row 2|_max |row 3|_max. The factor is 16 instead of 14 to cover the rounding of the norms and of the
/// bound itself.
constexpr double exact_row_bound = 16 * unit_roundoff;

/// The same with three rounded rows: 8 roundings a term, so 18 instead of 16.
constexpr double rounded_rows_bound = 18 * unit_roundoff;

/// If a determinant is closer to zero than 2^20 times its error bound, integers decide, because t would be
/// imprecise.
constexpr double loose_determinant = 0x1p20;

/// Factors that make a nonnegative quotient a lower or an upper bound, although its sum, difference and
/// division (3 u) and this product (1 u) were rounded: 8 u.
constexpr double round_down = 1.0 - 0x1p-50;
constexpr double round_up = 1.0 + 0x1p-50;

inline double norm_max(const glm::dvec3& v) {
  return std::max(std::max(std::abs(v.x), std::abs(v.y)), std::abs(v.z));
}
inline double norm_one(const glm::dvec3& v) {
  return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
}

/// An interval that contains the exact t of a hit.
struct Enclosure {
  double low;
  double high;
};
enum class Verdict { miss, hit, doubt };

/// Decides hit or miss by integers. For a hit it bounds t as tightly as doubles can.
bool enclose_exactly(const Mesh::Corners& corners, const Ray& ray, Enclosure& t);

/// Whether triangle `left` comes before `right`, both hit by the ray: smaller exact t, or equal and lower
/// index.
bool before_exactly(const Mesh& mesh, std::uint32_t left, std::uint32_t right, const Ray& ray);

/// Bounds the t of a hit whose edge signs are certain. In doubt if t might be negative or its bound is loose.
inline Verdict enclose(const Mesh::Corners& corners, const glm::dvec3& direction, const glm::dvec3& to_a,
                       Enclosure& t) {
  const glm::dvec3 a(corners.a);
  const glm::dvec3 side_b = glm::dvec3(corners.b) - a;
  const glm::dvec3 side_c = glm::dvec3(corners.c) - a;
  const glm::dvec3 normal = glm::cross(side_b, side_c);
  const double sides = norm_max(side_b) * norm_max(side_c);
  const double determinant = glm::dot(direction, normal);
  const double determinant_error = exact_row_bound * norm_one(direction) * sides;
  const double height = glm::dot(to_a, normal);
  const double height_error = rounded_rows_bound * norm_one(to_a) * sides;
  const double d = std::abs(determinant);
  const double h = std::abs(height);
  if (d <= loose_determinant * determinant_error || h <= height_error) {
    return Verdict::doubt;
  }
  if ((determinant < 0) != (height < 0)) {
    return Verdict::miss;
  }
  t = {(h - height_error) / (d + determinant_error) * round_down,
       (h + height_error) / (d - determinant_error) * round_up};
  return Verdict::hit;
}

/// Hit or miss of the ray's line with t >= 0, by double arithmetic alone; bounds t for a hit.
inline Verdict classify(const Mesh::Corners& corners, const Ray& ray, Enclosure& t) {
  const glm::dvec3 origin(ray.origin);
  const glm::dvec3 direction(ray.direction);
  const glm::dvec3 a = glm::dvec3(corners.a) - origin;
  const glm::dvec3 b = glm::dvec3(corners.b) - origin;
  const glm::dvec3 c = glm::dvec3(corners.c) - origin;
  // The side on which the line passes each edge: direction . (b x c), direction . (c x a), direction . (a x
  // b).
  const glm::dvec3 moment = glm::cross(direction, a);
  const double edge_bc = glm::dot(direction, glm::cross(b, c));
  const double edge_ca = -glm::dot(moment, c);
  const double edge_ab = glm::dot(moment, b);
  const double reach = std::max(std::max(norm_max(a), norm_max(b)), norm_max(c));
  const double error = exact_row_bound * norm_one(direction) * reach * reach;
  const double lowest = std::min(std::min(edge_bc, edge_ca), edge_ab);
  const double highest = std::max(std::max(edge_bc, edge_ca), edge_ab);
  if (lowest < -error && highest > error) {
    return Verdict::miss;
  }
  if (lowest <= error && highest >= -error) {
    return Verdict::doubt;
  }
  return enclose(corners, direction, a, t);
}

}  // namespace triangle_filter

inline bool intersect_triangle(const Mesh& mesh, std::uint32_t triangle, const Ray& ray, Hit& best) {
  return intersect_triangle(mesh, triangle, mesh.corners(triangle), ray, best);
}

inline bool intersect_triangle(const Mesh& mesh, std::uint32_t triangle, const Mesh::Corners& corners,
                               const Ray& ray, Hit& best) {
  using triangle_filter::Verdict;
  triangle_filter::Enclosure t{};
  const Verdict verdict = triangle_filter::classify(corners, ray, t);
  if (verdict == Verdict::miss) {
    return false;
  }
  // The choice of path must not depend on `best`: otherwise the interval of a hit would depend on the order
  // of the tests.
  const double length = ray.length;
  const bool certain = verdict == Verdict::hit && (t.high <= length || t.low > length);
  if (certain ? t.low > length : !triangle_filter::enclose_exactly(corners, ray, t)) {
    return false;
  }
  if (t.low > best.t_high || triangle == best.triangle) {
    return false;  // farther, or the same triangle in another leaf
  }
  if (t.high >= best.t_low && !triangle_filter::before_exactly(mesh, triangle, best.triangle, ray)) {
    return false;
  }
  best = {triangle, t.low, t.high};
  return true;
}

}  // namespace hitpipe::ref
