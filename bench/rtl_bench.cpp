// How long a design takes to generate, and how many box tests the Verilated one answers inside a
// co-simulation.
#include <benchmark/benchmark.h>

#include "rtl_gen/emit/files.hpp"
#include "rtl_gen/pipeline.hpp"
#include "sim/cosim.hpp"

namespace {

using namespace hitpipe;

/// Everything `hitpipe rtl` computes but for the writing: trace, schedule, Verilog, manifest, testbench,
/// schematic.
void generate_int_slabs(benchmark::State& state) {
  const rtl::Design& design = rtl::find_design("int_slabs");
  const rtl::Library& library = rtl::Library::thesis();
  constexpr hls::IntBits bits{24, 24};
  for (auto _ : state) {
    auto files = rtl::emit(design, bits, library, rtl::make_pipeline(design.trace(bits), library));
    files.push_back(rtl::draw(files));
    benchmark::DoNotOptimize(files);
  }
}
BENCHMARK(generate_int_slabs)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

/// Box tests per second of one core: Verilog, C++ check, traversal and triangle tests together.
void cosimulate_spheres(benchmark::State& state) {
  const rtl::Design& design = rtl::find_design("int_slabs");
  constexpr hls::IntBits bits{20, 24};
  const ref::Scene scene = ref::load_scene("spheres");
  const ref::Bvh bvh = ref::build_bvh(scene.mesh);
  const sim::VerilatedDesign verilated(design, bits, rtl::Library::thesis());
  double tests = 0;
  double seconds = 0;
  for (auto _ : state) {
    const sim::CosimResult result =
        sim::cosimulate(design, bits, verilated, scene, bvh, {.width = 256, .height = 256});
    tests += static_cast<double>(result.unit.box_tests);
    seconds += result.rtl_seconds;
    state.SetIterationTime(result.rtl_seconds);
  }
  state.counters["rtl_tests_per_s"] = tests / seconds;
}
BENCHMARK(cosimulate_spheres)->Unit(benchmark::kMillisecond)->UseManualTime();

}  // namespace
