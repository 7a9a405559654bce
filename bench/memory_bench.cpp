// The memory model of a traversal core with a request in every cycle in which it is ready, at random blocks.
// One item is one cycle. Arguments: blocks of the image, KiB of the cache.
#include <cstddef>
#include <cstdint>
#include <vector>

#include <benchmark/benchmark.h>

#include "sim/core/memory_model.hpp"

namespace {

namespace ref = hitpipe::ref;
namespace sim = hitpipe::sim;

void ask(benchmark::State& state, sim::MemoryOptions options) {
  const std::vector<ref::CoreBlock> image(static_cast<std::size_t>(state.range(0)),
                                          ref::CoreBlock{1, 2, 3, 4});
  options.cache_kib = static_cast<int>(state.range(1));
  sim::MemoryModel memory(image, options);
  ref::adversary::Random random(1);
  std::uint32_t tag = 0;
  for (auto _ : state) {
    if (memory.ready()) memory.ask(static_cast<std::uint32_t>(random.below(image.size())), ++tag);
    benchmark::DoNotOptimize(memory.step());
  }
  state.SetItemsProcessed(state.iterations());
}
void sizes(benchmark::internal::Benchmark* bench) {
  bench->ArgsProduct({{1000, 38'373, 3'036'679}, {0, 64}});
}
// 192 requests are what a core of 192 rays has on their way.
BENCHMARK_CAPTURE(ask, latency_100, sim::MemoryOptions{.most_waiting = 192})->Apply(sizes);
BENCHMARK_CAPTURE(ask, latency_1_to_200,
                  sim::MemoryOptions{.least_latency = 1, .most_latency = 200, .most_waiting = 192})
    ->Apply(sizes);
BENCHMARK_CAPTURE(ask, in_order_1_to_200,
                  sim::MemoryOptions{
                      .least_latency = 1, .most_latency = 200, .in_order = true, .most_waiting = 192})
    ->Apply(sizes);

}  // namespace
