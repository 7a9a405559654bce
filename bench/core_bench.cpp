// Cycles a second of a core as Verilog and as C++, which run by turns: of each the fastest run. The memory
// around the core and the rays are those of `hitpipe core trace`; making the rays and the core is not timed.
#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <memory>
#include <vector>

#include <benchmark/benchmark.h>

#include "rays/image/core_image.hpp"
#include "rays/scene/scene.hpp"
#include "rays/world/int_scene.hpp"
#include "rtl_gen/component/library.hpp"
#include "rtl_gen/core/core.hpp"
#include "sim/core/core_trace.hpp"
#include "sim/core/native_core.hpp"
#include "sim/core/picture_rays.hpp"
#include "sim/machine/verilated_machine.hpp"
#include "sw_ref/scene/load_scene.hpp"

namespace {

using namespace hitpipe;

template <class Work>
double seconds_of(Work&& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void core(benchmark::State& state) {
  const ref::Scene loaded = ref::load_scene("spheres");
  rtl::CoreOptions options{.rays = static_cast<int>(state.range(0))};
  const auto scene = std::make_shared<const ref::IntScene>(
      ref::int_scene(loaded, options.bits.world(), {.build = ref::surface_area_build}));
  const ref::CoreImage image = ref::core_image(*scene);
  sim::make_room(options, image);
  const sim::PictureRays rays =
      sim::picture_rays(scene, image, {.world = options.bits.world(), .boxes = options.bits.boxes()},
                        {.width = 96, .height = 96});
  const rtl::Library library = rtl::library_called(rtl::default_library);
  const rtl::Core made = rtl::make_core(options, library);
  sim::VerilatedMachine verilog(made, rtl::to_verilog(made, library));
  sim::NativeCore native(made);
  const std::array<rtl::NativeMachine*, 2> machines{&verilog, &native};

  std::vector<sim::CoreAnswer> answers(rays.jobs.size());
  const sim::MemoryOptions memory{};
  std::array<double, 2> seconds{1e9, 1e9};
  double cycles = 0;
  for (auto _ : state) {
    for (std::size_t i = 0; i < machines.size(); ++i) {
      sim::CoreBench bench(made, *machines[i], image, memory);
      seconds[i] = std::min(seconds[i], seconds_of([&] { bench.run(rays.jobs, answers); }));
      cycles = static_cast<double>(bench.counts().cycles);
    }
  }
  state.counters["verilog_per_s"] = cycles / seconds[0];
  state.counters["native_per_s"] = cycles / seconds[1];
  state.counters["native_to_verilog"] = seconds[0] / seconds[1];
}
BENCHMARK(core)->ArgName("rays")->Arg(32)->Arg(128)->Unit(benchmark::kMillisecond);

}  // namespace
