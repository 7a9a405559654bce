// Primary rays per second of one core, closest hit, for each software box test; the rays are made beforehand.
// HITPIPE_BENCH_MESH names a mesh file (or built-in scene) to trace in place of Spheres.
#include <cstdlib>
#include <vector>

#include <benchmark/benchmark.h>

#include "sw_ref/bvh/bvh.hpp"
#include "sw_ref/render/camera.hpp"
#include "sw_ref/scene/scene.hpp"
#include "sw_ref/traverse/slabs.hpp"
#include "sw_ref/traverse/traversal.hpp"

namespace {

namespace ref = hitpipe::ref;

constexpr int image_side = 512;

struct Workload {
  ref::Scene scene;
  ref::Bvh bvh;
  std::vector<ref::Ray> rays;

  explicit Workload(const char* name) : scene(ref::load_scene(name)), bvh(ref::build_bvh(scene.mesh)) {
    for (int y = 0; y < image_side; ++y)
      for (int x = 0; x < image_side; ++x)
        rays.push_back(ref::primary_ray(scene.camera, x, y, image_side, image_side));
  }
};

const Workload& workload() {
  const char* const name = std::getenv("HITPIPE_BENCH_MESH");
  static const Workload it(name ? name : "spheres");
  return it;
}

template <class BoxTest>
void primary_rays(benchmark::State& state) {
  const Workload& work = workload();
  ref::TraversalCounts counts;
  for (auto _ : state) {
    for (const ref::Ray& ray : work.rays)
      benchmark::DoNotOptimize(
          ref::trace<BoxTest>(work.bvh, work.scene.mesh, ray, ref::Query::closest, counts).triangle);
  }
  const auto rays = static_cast<double>(state.iterations()) * static_cast<double>(work.rays.size());
  state.counters["rays/s"] = benchmark::Counter(rays, benchmark::Counter::kIsRate);
  state.counters["boxes/ray"] = static_cast<double>(counts.box_tests) / rays;
  state.counters["triangles/ray"] = static_cast<double>(counts.triangle_tests) / rays;
}
BENCHMARK(primary_rays<ref::FloatSlabs>)->Unit(benchmark::kMillisecond);
BENCHMARK(primary_rays<ref::RobustSlabs>)->Unit(benchmark::kMillisecond);

void build(benchmark::State& state) {
  const ref::Mesh& mesh = workload().scene.mesh;
  for (auto _ : state) benchmark::DoNotOptimize(ref::build_bvh(mesh).nodes.size());
  state.counters["triangles/s"] = benchmark::Counter(static_cast<double>(mesh.triangles.size()),
                                                     benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(build)->Unit(benchmark::kMillisecond);

}  // namespace
