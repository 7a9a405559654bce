// Seconds to build the hierarchy with both builders, and seconds per n log2 n, to show how building scales.
// The meshes are closed bumpy spheres of 0.3, 1.1, 4.5, 18 and 28 million triangles of even size. Each runs
// one iteration; 28 million take a while. The rate uses processor time of all threads together. Bytes per
// triangle: the most memory that the process held beyond the mesh. HITPIPE_BENCH_THREADS limits the threads
// (default: one for each core). HITPIPE_BENCH_MESH names another mesh file or built-in scene to build for.
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <string>

#include <benchmark/benchmark.h>
#include <glm/geometric.hpp>

#include "rays/scene/scene.hpp"
#include "rays/tree/bvh.hpp"
#include "sw_ref/hierarchy/statistics.hpp"
#include "sw_ref/scene/load_scene.hpp"

namespace {

namespace ref = hitpipe::ref;

constexpr float pi = 3.14159265F;

/// Rows of latitude, and twice as many columns of longitude; two triangles for each cell.
ref::Mesh bumpy_sphere(std::uint32_t rows) {
  const std::uint32_t columns = 2 * rows;
  ref::Mesh mesh;
  mesh.vertices.reserve(std::size_t{rows + 1} * columns);
  for (std::uint32_t row = 0; row <= rows; ++row) {
    for (std::uint32_t column = 0; column < columns; ++column) {
      const float theta = pi * (static_cast<float>(row) + 0.5F) / (static_cast<float>(rows) + 1.0F);
      const float phi = pi * static_cast<float>(column) / static_cast<float>(rows);
      const glm::vec3 p(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
      float radius = 0.7F;
      for (float wave = 4.0F, height = 0.1F; wave < 2000.0F; wave *= 2.1F, height *= 0.45F)
        radius += height * std::sin(wave * p.x + height) * std::sin(wave * p.y) * std::cos(wave * p.z);
      mesh.vertices.push_back(p * radius);
    }
  }
  mesh.triangles.reserve(std::size_t{2} * rows * columns);
  for (std::uint32_t row = 0; row < rows; ++row) {
    for (std::uint32_t column = 0; column < columns; ++column) {
      const std::uint32_t here = row * columns;
      const std::uint32_t next = (column + 1) % columns;
      mesh.triangles.emplace_back(here + column, here + next, here + columns + column);
      mesh.triangles.emplace_back(here + next, here + columns + next, here + columns + column);
    }
  }
  return mesh;
}

/// A line of /proc/self/status in bytes. 0 on systems without that file.
double status_bytes(const std::string& key) {
  std::ifstream file("/proc/self/status");
  for (std::string word; file >> word;) {
    double kib = 0;
    if (word == key + ":" && file >> kib) return kib * 1024.0;
  }
  return 0;
}

/// Resets the largest size of the process.
void forget_peak() {
  std::ofstream("/proc/self/clear_refs") << "5";
}

ref::BuildOptions options_for(ref::Builder builder) {
  const char* const threads = std::getenv("HITPIPE_BENCH_THREADS");
  ref::BuildOptions options{.builder = builder};
  if (threads != nullptr) options.threads = std::atoi(threads);
  return options;
}

void measure(benchmark::State& state, const ref::Mesh& mesh, ref::Builder builder) {
  const ref::BuildOptions options = options_for(builder);
  const double before = status_bytes("VmRSS");
  forget_peak();
  ref::Bvh bvh;
  for (auto _ : state) bvh = ref::build_bvh(mesh, options);
  const double peak = status_bytes("VmHWM") - before;
  const auto triangles = static_cast<double>(mesh.triangles.size());
  const ref::BvhStatistics statistics = ref::statistics(bvh);
  state.counters["triangles"] = triangles;
  state.counters["nodes"] = static_cast<double>(statistics.nodes);
  state.counters["depth"] = statistics.depth;
  state.counters["sah_cost"] = statistics.sah_cost;
  state.counters["peak_bytes/triangle"] = peak / triangles;
  state.counters["s/(n*log2(n))"] =
      benchmark::Counter(triangles * std::log2(triangles),
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

template <ref::Builder builder>
void build(benchmark::State& state) {
  measure(state, bumpy_sphere(static_cast<std::uint32_t>(state.range(0))), builder);
}
void sizes(benchmark::internal::Benchmark* benchmark) {
  for (const int rows : {274, 530, 1060, 2120, 2649}) benchmark->Arg(rows);
  benchmark->ArgName("rows")->Unit(benchmark::kSecond)->Iterations(1)->MeasureProcessCPUTime();
}
BENCHMARK(build<ref::Builder::median>)->Apply(sizes);
BENCHMARK(build<ref::Builder::sah>)->Apply(sizes);

const ref::Mesh& named_mesh() {
  const char* const name = std::getenv("HITPIPE_BENCH_MESH");
  static const ref::Scene scene = ref::load_scene(name != nullptr ? name : "spheres");
  return scene.mesh;
}

template <ref::Builder builder>
void build_named(benchmark::State& state) {
  measure(state, named_mesh(), builder);
}
BENCHMARK(build_named<ref::Builder::median>)->Unit(benchmark::kSecond)->MeasureProcessCPUTime();
BENCHMARK(build_named<ref::Builder::sah>)->Unit(benchmark::kSecond)->MeasureProcessCPUTime();

}  // namespace
