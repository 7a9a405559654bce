// Primary rays per second of one core, closest hit: every algorithm, encoding and bundle size, and Embree 3
// for comparison if it is installed. The rays are made in advance and come in tiles of 8 x 8 or 16 x 16
// pixels. HITPIPE_BENCH_MESH names a mesh file or built-in scene to trace in place of Spheres.
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "rays/scene/scene.hpp"
#include "rays/trace/tracer.hpp"
#include "rays/tree/bvh.hpp"
#include "sw_ref/render/camera.hpp"
#include "sw_ref/scene/load_scene.hpp"
#ifdef HITPIPE_EMBREE
#include "bench/embree_tracer.hpp"
#endif

namespace {

namespace ref = hitpipe::ref;
using ref::Algorithm;
using ref::Arithmetic;
using ref::Encoding;
using ref::TriangleTest;

constexpr int image_side = 512;

std::vector<ref::Ray> tiled_rays(const ref::Camera& camera, int tile_side) {
  std::vector<ref::Ray> rays;
  for (int top = 0; top < image_side; top += tile_side) {
    for (int left = 0; left < image_side; left += tile_side) {
      for (int i = 0; i < tile_side * tile_side; ++i) {
        rays.push_back(
            ref::primary_ray(camera, left + i % tile_side, top + i / tile_side, image_side, image_side));
      }
    }
  }
  return rays;
}

struct Workload {
  ref::Scene scene;
  ref::Bvh median, sah;
  std::vector<ref::Ray> rays_64, rays_256;
  std::vector<std::uint32_t> triangles;

  explicit Workload(const char* name) : scene(ref::load_scene(name)), median(ref::build_bvh(scene.mesh)) {
    ref::BuildOptions options;
    options.builder = ref::Builder::sah;
    sah = ref::build_bvh(scene.mesh, options);
    rays_64 = tiled_rays(scene.camera, 8);
    rays_256 = tiled_rays(scene.camera, 16);
    triangles.resize(rays_64.size());
  }
};

Workload& workload() {
  const char* const name = std::getenv("HITPIPE_BENCH_MESH");
  static Workload it(name ? name : "spheres");
  return it;
}

void report(benchmark::State& state, const ref::TraceCounts& counts) {
  const auto rays = static_cast<double>(counts.rays);
  state.counters["rays/s"] = benchmark::Counter(rays, benchmark::Counter::kIsRate);
  state.counters["boxes/ray"] = static_cast<double>(counts.box_tests) / rays;
  state.counters["triangles/ray"] = static_cast<double>(counts.triangle_tests) / rays;
  state.counters["nodes/ray"] = static_cast<double>(counts.nodes_loaded) / rays;
}

void primary_rays(benchmark::State& state, bool sah, const ref::TracerOptions& options) {
  Workload& work = workload();
  const auto tracer = ref::make_tracer(work.scene.mesh, sah ? work.sah : work.median, options);
  const std::vector<ref::Ray>& rays = options.bundle == 256 ? work.rays_256 : work.rays_64;
  ref::TraceCounts counts;
  for (auto _ : state) tracer->trace({rays, ref::Query::closest, work.triangles}, counts);
  report(state, counts);
}

#ifdef HITPIPE_EMBREE
void embree(benchmark::State& state) {
  Workload& work = workload();
  const hitpipe::bench::EmbreeTracer tracer(work.scene.mesh);
  ref::TraceCounts counts;
  for (auto _ : state) {
    tracer.trace(work.rays_64, work.triangles);
    counts.rays += work.rays_64.size();
  }
  report(state, counts);
}
BENCHMARK(embree)->Unit(benchmark::kMillisecond);
#endif

struct Named {
  const char* name;
  Algorithm algorithm;
};
constexpr Named algorithms[] = {{"slabs", Algorithm::slabs},
                                {"plu", Algorithm::plu},
                                {"slabs_dist", Algorithm::slabs_dist},
                                {"slabs_dsa", Algorithm::slabs_dsa},
                                {"plu_dsa", Algorithm::plu_dsa}};

void add(const std::string& name, bool sah, const ref::TracerOptions& options) {
  benchmark::RegisterBenchmark(
      ((sah ? "sah/" : "median/") + name + '/' + std::to_string(options.bundle)).c_str(),
      [=](benchmark::State& state) { primary_rays(state, sah, options); })
      ->Unit(benchmark::kMillisecond);
}

const bool registered = [] {
  for (const bool sah : {false, true}) {
    for (const Named& each : algorithms) {
      for (const int bundle : {1, 64, 256}) {
        if (bundle > 1 && each.algorithm == Algorithm::slabs_dist) continue;
        ref::TracerOptions options{.algorithm = each.algorithm,
                                   .arithmetic = Arithmetic::binary32,
                                   .bundle = bundle,
                                   .triangle_test = TriangleTest::binary32};
        add(std::string(each.name) + "/moeller_trumbore", sah, options);
      }
    }
  }
  ref::TracerOptions options{.arithmetic = Arithmetic::conservative};
  add("slabs_dsa/conservative/exact", false, options);
  options = {.algorithm = Algorithm::plu_dsa, .arithmetic = Arithmetic::binary64};
  options.triangle_test = TriangleTest::binary64;
  add("plu_dsa/binary64/moeller_trumbore", false, options);
  for (const int bundle : {1, 64}) {
    options = {.algorithm = Algorithm::plu_dsa, .arithmetic = Arithmetic::binary32};
    options.bundle = bundle;
    options.triangle_test = TriangleTest::binary32;
    options.encoding = Encoding::hierarchical_4;
    add("plu_dsa/4 bits", false, options);
    options.encoding = Encoding::hierarchical_8;
    add("plu_dsa/8 bits", false, options);
    options.look_up_table = true;
    add("plu_dsa/8 bits, table", false, options);
  }
  options = {.arithmetic = Arithmetic::integer};
  options.triangle_test = TriangleTest::binary32;
  add("slabs_dsa/24 of 24 bits", false, options);
  return true;
}();

void build(benchmark::State& state) {
  const ref::Mesh& mesh = workload().scene.mesh;
  for (auto _ : state) benchmark::DoNotOptimize(ref::build_bvh(mesh).nodes.size());
  state.counters["triangles/s"] = benchmark::Counter(static_cast<double>(mesh.triangles.size()),
                                                     benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(build)->Unit(benchmark::kMillisecond);

}  // namespace
