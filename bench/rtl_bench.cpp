// How long a design takes to generate, and how many box tests the Verilated design answers in a
// co-simulation.
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "rays/exact/box_referee.hpp"
#include "rtl_gen/emit/unit_folder.hpp"
#include "rtl_gen/pipeline.hpp"
#include "sim/cosim/cosim.hpp"
#include "sim/cosim/sampled_time.hpp"
#include "sim/cosim/walk.hpp"
#include "sim/unit/verilated_design.hpp"
#include "sw_ref/scene/load_scene.hpp"

namespace {

using namespace hitpipe;

/// Everything that `hitpipe rtl` computes, without writing files: trace, schedule, Verilog, manifest,
/// testbench, schematics.
void generate(benchmark::State& state, const std::string& name) {
  const rtl::Design& design = rtl::find_design(name);
  const rtl::Library& library = rtl::Library::thesis();
  const hitpipe::Format format = design.default_format;
  for (auto _ : state) {
    auto files = rtl::files_and_drawings(rtl::emit(rtl::make_unit(design, format, library)));
    benchmark::DoNotOptimize(files);
  }
}

/// Nanoseconds a test of the loop's parts: how primary rays walk with the answers of the C++ datapath.
class Parts {
 public:
  Parts(const rtl::Design& design, const hitpipe::Format& format, const ref::Scene& scene,
        const ref::Bvh& bvh)
      : feed_(sim::make_feed(design, format, bvh)),
        rays_(feed_->unit(1)),
        operands_(design.ports(format).size()) {
    const rtl::Evaluate bit_level = design.evaluate(format);
    const std::optional<rtl::Evaluate> on_float_unit = design.evaluate_on_float_unit(format);
    const std::vector<hls::Result> results = design.results(format);
    std::vector<std::int64_t> answers(results.size());
    const ref::Whitted whitted(scene, {});
    sim::with_walk({feed_.get(), &bvh, &scene.mesh}, results, [&](const auto& walk) {
      for (std::uint32_t pixel = 0; pixel < side * side; ++pixel) {
        const ref::RayTask task = whitted.primary(static_cast<int>(pixel) % side,
                                                  static_cast<int>(pixel) / side, side, side, pixel);
        if (!ref::acceptable(task.ray)) continue;
        auto traversal = walk.start(*rays_, 0, task.ray, task.query());
        while (!traversal.done()) {
          ++tests_;
          set_up_.run([&] { walk.ask(*rays_, 0, traversal, operands_.data()); });
          if (on_float_unit) float_unit_.run([&] { (*on_float_unit)(operands_.data(), answers.data()); });
          bit_level_.run([&] { bit_level(operands_.data(), answers.data()); });
          traversal_.run([&] { walk.answer(*rays_, 0, traversal, answers.data()); });
        }
      }
    });
  }

  void report(benchmark::State& state) const {
    const auto one = [&](const char* name, const sim::SampledTime<>& time) {
      state.counters[name] = 1e9 * time.seconds() / static_cast<double>(tests_);
    };
    one("set_up_ns", set_up_);
    one("bit_level_ns", bit_level_);
    one("float_unit_ns", float_unit_);
    one("traversal_ns", traversal_);
  }

 private:
  static constexpr int side = 128;

  std::unique_ptr<sim::SceneFeed> feed_;
  std::unique_ptr<sim::RayFeed> rays_;
  std::vector<std::int64_t> operands_;
  std::uint64_t tests_ = 0;
  sim::SampledTime<> set_up_, bit_level_, float_unit_, traversal_;
};

/// Tests and boxes per second of one core: by the Verilog alone, and by the whole loop with set-up, C++
/// check, traversal and triangle tests. Then nanoseconds a test: of the loop, of the loop with all tests
/// compared bit by bit, of what the referee adds, and of the loop's parts.
void cosimulate_spheres(benchmark::State& state, const std::string& name) {
  const rtl::Design& design = rtl::find_design(name);
  const hitpipe::Format format = design.default_format;
  const ref::Scene scene = ref::load_scene("spheres");
  const ref::Bvh bvh = ref::build_bvh(scene.mesh);
  const sim::VerilatedDesign verilated(rtl::make_unit(design, format, rtl::Library::thesis()));
  sim::CosimResult all;
  double bit_level_seconds = 0;
  double referee_seconds = 0;
  for (auto _ : state) {
    const auto run = [&](const sim::CosimOptions& options) {
      return sim::cosimulate(verilated, scene, bvh, options);
    };
    const sim::CosimResult result = run({.width = 256, .height = 256});
    bit_level_seconds += run({.width = 256, .height = 256, .bit_level = true}).loop_seconds;
    referee_seconds += run({.width = 256, .height = 256, .referee = true}).loop_seconds;
    all.unit += result.unit;
    all.rtl_seconds += result.rtl_seconds;
    all.loop_seconds += result.loop_seconds;
    state.SetIterationTime(result.loop_seconds);
  }
  state.counters["rtl_tests_per_s"] = all.rtl_tests_per_s();
  state.counters["loop_tests_per_s"] = all.loop_tests_per_s();
  state.counters["rtl_boxes_per_s"] = all.rtl_boxes_per_s();
  state.counters["loop_boxes_per_s"] = all.loop_boxes_per_s();
  const double ns = 1e9 / static_cast<double>(all.unit.tests);
  state.counters["loop_ns"] = all.loop_seconds * ns;
  state.counters["loop_bit_level_ns"] = bit_level_seconds * ns;
  state.counters["referee_ns"] = (referee_seconds - all.loop_seconds) * ns;
  state.counters["rtl_ns"] = all.rtl_seconds * ns;
  Parts(design, format, scene, bvh).report(state);
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
