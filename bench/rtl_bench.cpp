// How long a design takes to generate, and how many box tests the Verilated design answers in a
// co-simulation.
#include <string>

#include <benchmark/benchmark.h>

#include "rtl_gen/emit/unit_folder.hpp"
#include "rtl_gen/pipeline.hpp"
#include "sim/cosim.hpp"

namespace {

using namespace hitpipe;

/// Everything that `hitpipe rtl` computes, without writing files: trace, schedule, Verilog, manifest,
/// testbench, schematics.
void generate(benchmark::State& state, const std::string& name) {
  const rtl::Design& design = rtl::find_design(name);
  const rtl::Library& library = rtl::Library::thesis();
  const rtl::Format format = design.default_format;
  for (auto _ : state) {
    auto files = rtl::files_and_drawings(
        rtl::emit(design, format, library, rtl::make_pipeline(design.trace(format), library)));
    benchmark::DoNotOptimize(files);
  }
}

/// Tests and boxes per second of one core: by the Verilog alone, and by the whole loop with set-up, C++
/// check, traversal and triangle tests.
void cosimulate_spheres(benchmark::State& state, const std::string& name) {
  const rtl::Design& design = rtl::find_design(name);
  const rtl::Format format = design.default_format;
  const ref::Scene scene = ref::load_scene("spheres");
  const ref::Bvh bvh = ref::build_bvh(scene.mesh);
  const sim::VerilatedDesign verilated(design, format, rtl::Library::thesis());
  double tests = 0;
  double boxes = 0;
  double rtl_seconds = 0;
  double loop_seconds = 0;
  for (auto _ : state) {
    const sim::CosimResult result =
        sim::cosimulate(design, format, verilated, scene, bvh, {.width = 256, .height = 256});
    tests += static_cast<double>(result.unit.tests);
    boxes += static_cast<double>(result.unit.box_tests);
    rtl_seconds += result.rtl_seconds;
    loop_seconds += result.loop_seconds;
    state.SetIterationTime(result.loop_seconds);
  }
  state.counters["rtl_tests_per_s"] = tests / rtl_seconds;
  state.counters["loop_tests_per_s"] = tests / loop_seconds;
  state.counters["rtl_boxes_per_s"] = boxes / rtl_seconds;
  state.counters["loop_boxes_per_s"] = boxes / loop_seconds;
}

const bool registered = [] {
  for (const rtl::Design& design : rtl::designs()) {
    const std::string name(design.name);
    benchmark::RegisterBenchmark(("generate/" + name).c_str(), generate, name)
        ->Unit(benchmark::kMillisecond)
        ->MeasureProcessCPUTime()
        ->UseRealTime();
    benchmark::RegisterBenchmark(("cosimulate_spheres/" + name).c_str(), cosimulate_spheres, name)
        ->Unit(benchmark::kMillisecond)
        ->UseManualTime();
  }
  return true;
}();

}  // namespace
