#include "rays/trace/leaf.hpp"

#include <cmath>
#include <stdexcept>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace hitpipe::ref {
namespace {

/// The two-sided test of Moeller and Trumbore (1997), in binary32 or binary64, which the thesis times. Because of
/// rounding it accepts some points outside the triangle and loses some on shared edges. It is one triangle, loaded
/// and set up for any number of rays.
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

/// The exact test with the interface of the others. It has no set-up that rays could share.
class ExactTriangle {
 public:
  ExactTriangle(const Mesh& mesh, std::uint32_t triangle) : mesh_(mesh), index_(triangle) {}
  bool operator()(const Ray& ray, Hit& best) const { return intersect_triangle(mesh_, index_, ray, best); }

 private:
  const Mesh& mesh_;
  std::uint32_t index_;
};

template <class Triangle>
std::uint32_t test_ray(const Mesh& mesh, std::span<const std::uint32_t> triangles, const Ray& ray,
                       Query query, Hit& best) {
  std::uint32_t tests = 0;
  for (const std::uint32_t index : triangles) {
    ++tests;
    if (Triangle(mesh, index)(ray, best) && query == Query::any) break;
  }
  return tests;
}

template <class Triangle>
LeafCounts test_bundle(const Mesh& mesh, std::span<const std::uint32_t> triangles, BundledRay* rays,
                       RayNumbers numbers, Query query) {
  LeafCounts sum;
  for (const std::uint32_t index : triangles) {
    if (numbers.empty()) break;
    const Triangle triangle(mesh, index);
    ++sum.loaded;
    sum.tests += numbers.size();
    std::size_t left = 0;
    for (const std::uint16_t number : numbers) {
      BundledRay& ray = rays[number];
      if (ray.work != nullptr) ++ray.work->triangle_tests;
      const bool out = triangle(ray.ray, ray.hit) && query == Query::any;
      numbers[left] = number;
      left += out ? 0 : 1;
    }
    numbers = numbers.first(left);
  }
  return sum;
}

template <class Triangle>
constexpr LeafTest both{&test_ray<Triangle>, &test_bundle<Triangle>};

}  // namespace

const LeafTest& leaf_test(TriangleTest test) {
  switch (test) {
    case TriangleTest::binary32:
      return both<MoellerTrumbore<float>>;
    case TriangleTest::binary64:
      return both<MoellerTrumbore<double>>;
    case TriangleTest::exact:
      break;
  }
  return both<ExactTriangle>;
}

void check_places(const TraceJob& job) {
  if (job.triangles.size() != job.rays.size() || (!job.work.empty() && job.work.size() != job.rays.size()))
    throw std::invalid_argument("tracer: places for answers and work must be as many as the rays");
}

}  // namespace hitpipe::ref
