#include "rays/trace/leaf_test.hpp"

#include <stdexcept>

#include "rays/trace/moeller_trumbore.hpp"

namespace hitpipe::ref {
namespace {

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
