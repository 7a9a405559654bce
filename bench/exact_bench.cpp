// The exact arithmetic of sw_ref on random input with a fixed seed: box referee (filtered, and integers
// only), triangle test on small triangles (one test in four and one in 28 is a hit), distances and weights of hits, box
// quantisation, integer ray set-up, and the length of a shortened ray. One item is one test or one set-up. The data fit
// the first cache levels.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include <benchmark/benchmark.h>
#include <glm/geometric.hpp>

#include "rays/exact/box_referee.hpp"
#include "rays/exact/exact_triangle.hpp"
#include "rays/world/int_box.hpp"
#include "sw_ref/quantise/int_slabs_ray.hpp"

namespace {

namespace hls = hitpipe::hls;
namespace ref = hitpipe::ref;

constexpr std::size_t case_count = 1024;
constexpr unsigned seed = 2005;

using Random = std::mt19937;

glm::vec3 random_point(Random& random, float range) {
  std::uniform_real_distribution<float> value(-range, range);
  return {value(random), value(random), value(random)};
}

std::vector<ref::Ray> random_rays() {
  Random random(seed);
  std::vector<ref::Ray> rays(case_count);
  for (ref::Ray& ray : rays) {
    ray.origin = random_point(random, 1);
    ray.direction = random_point(random, 1);
    ray.length = 1;
  }
  return rays;
}

std::vector<ref::Aabb> random_boxes() {
  Random random(seed + 1);
  std::vector<ref::Aabb> boxes(case_count);
  for (ref::Aabb& box : boxes) {
    const glm::vec3 corner = random_point(random, 0.5F);
    box.grow(corner);
    box.grow(corner + random_point(random, 0.5F));
  }
  return boxes;
}

template <bool (*meets)(const ref::Ray&, const ref::Aabb&)>
void box_referee(benchmark::State& state) {
  const std::vector<ref::Ray> rays = random_rays();
  const std::vector<ref::Aabb> boxes = random_boxes();
  for (auto _ : state) {
    std::size_t hits = 0;
    for (std::size_t i = 0; i < case_count; ++i) {
      hits += meets(rays[i], boxes[i]) ? 1U : 0U;
    }
    benchmark::DoNotOptimize(hits);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(case_count));
}
BENCHMARK(box_referee<ref::ray_meets_box>);
BENCHMARK(box_referee<ref::ray_meets_box_exact>);

/// Small triangles on a sphere with one ray for each. A ray is aimed near the centroid, off by up to `spread`
/// times the size.
struct TriangleCases {
  ref::Mesh mesh;
  std::vector<ref::Ray> rays;
};

TriangleCases triangle_cases(float spread) {
  Random random(seed + 2);
  TriangleCases cases;
  constexpr float size = 0.02F;
  for (std::uint32_t i = 0; i < case_count; ++i) {
    const glm::vec3 centre = 0.7F * glm::normalize(random_point(random, 1));
    for (int corner = 0; corner < 3; ++corner) {
      cases.mesh.vertices.push_back(centre + random_point(random, size));
    }
    cases.mesh.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
    ref::Ray ray;
    ray.origin = random_point(random, 1);
    ray.direction = centre + random_point(random, size * spread) - ray.origin;
    cases.rays.push_back(ray);
  }
  return cases;
}

void triangle_test(benchmark::State& state) {
  const TriangleCases cases = triangle_cases(static_cast<float>(state.range(0)) / 10);
  std::size_t hits = 0;
  for (auto _ : state) {
    hits = 0;
    for (std::uint32_t i = 0; i < case_count; ++i) {
      ref::Hit best;
      hits += ref::intersect_triangle(cases.mesh, i, cases.rays[i], best) ? 1U : 0U;
      benchmark::DoNotOptimize(best);
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(case_count));
  state.counters["hit_share"] = static_cast<double>(hits) / static_cast<double>(case_count);
}
BENCHMARK(triangle_test)->ArgName("spread_tenths")->Arg(0)->Arg(15);

/// Where a ray's line meets the plane of a triangle: its distance, or the weights of the corners too. `wide` has
/// origins with more digits than 128 bits allow.
template <auto find>
void plane(benchmark::State& state) {
  TriangleCases cases = triangle_cases(0);
  if (state.range(0) != 0)
    for (ref::Ray& ray : cases.rays) ray.origin.x = std::ldexp(ray.origin.x, -30);
  for (auto _ : state) {
    for (std::uint32_t i = 0; i < case_count; ++i)
      benchmark::DoNotOptimize(find(cases.mesh.corners(i), cases.rays[i]));
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(case_count));
}
BENCHMARK(plane<ref::plane_distance>)->ArgName("wide")->Arg(0)->Arg(1);
BENCHMARK(plane<ref::plane_point>)->ArgName("wide")->Arg(0)->Arg(1);

void quantise_box(benchmark::State& state) {
  const std::vector<ref::Aabb> boxes = random_boxes();
  for (auto _ : state) {
    for (const ref::Aabb& box : boxes) {
      benchmark::DoNotOptimize(ref::quantise_box(box, 24));
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(case_count));
}
BENCHMARK(quantise_box);

void int_slabs_ray_setup(benchmark::State& state) {
  const std::vector<ref::Ray> rays = random_rays();
  for (auto _ : state) {
    for (const ref::Ray& ray : rays) {
      const ref::IntSlabsRaySetup setup(ray, hls::IntBits{24, 24});
      benchmark::DoNotOptimize(setup.ray().length);
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(case_count));
}
BENCHMARK(int_slabs_ray_setup);

void int_slabs_ray_length(benchmark::State& state) {
  const ref::IntSlabsRaySetup setup(random_rays().front(), hls::IntBits{24, 24});
  Random random(seed);
  std::uniform_real_distribution<float> value(0, 2);
  std::vector<float> lengths(case_count);
  for (float& length : lengths) {
    length = value(random);
  }
  for (auto _ : state) {
    for (const float length : lengths) {
      benchmark::DoNotOptimize(setup.length(length));
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(case_count));
}
BENCHMARK(int_slabs_ray_length);

}  // namespace
