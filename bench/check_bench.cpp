// `hitpipe check` on one thread: draws a case, sets it up, runs the datapath in C++ and the exact referee,
// over every category. One item is one judged test. Run it on an idle core.
#include <cstdint>

#include <benchmark/benchmark.h>

#include "sim/check/check.hpp"

namespace {

namespace hls = hitpipe::hls;
namespace rtl = hitpipe::rtl;
namespace sim = hitpipe::sim;

constexpr std::uint64_t tests_per_run = 500'000;

void judge(benchmark::State& state, const char* name, hitpipe::Format format) {
  const rtl::Design& design = rtl::find_design(name);
  const auto all = hitpipe::ref::adversary::categories();
  sim::CheckOptions options{.categories = {all.begin(), all.end()}, .tests = tests_per_run};
  std::uint64_t tests = 0;
  for (auto _ : state) {
    for (const sim::CategoryResult& r :
         sim::check([&] { return sim::make_box_test(design, format); }, options)) {
      tests += r.tests;
    }
    ++options.seed;
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(tests));
}
BENCHMARK_CAPTURE(judge, int_slabs_24_24, "int_slabs", hitpipe::Format(hls::IntBits{24, 24}))
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(judge, int_slabs_20_24, "int_slabs", hitpipe::Format(hls::IntBits{20, 24}))
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(judge, int_plucker_24_24, "int_plucker", hitpipe::Format(hls::IntBits{24, 24}))
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(judge, int_plucker_20_24, "int_plucker", hitpipe::Format(hls::IntBits{20, 24}))
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(judge, fp_slabs, "fp_slabs", hitpipe::Format(hls::Binary32{}))
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(judge, fp_plucker, "fp_plucker", hitpipe::Format(hls::Binary32{}))
    ->Unit(benchmark::kMillisecond);

}  // namespace
