#include "sim/implement/clocks.hpp"

#include "rtl_gen/pipeline.hpp"

namespace hitpipe::sim {

std::vector<int> clocks_to_try(const rtl::Graph& graph, const rtl::Library& library, std::size_t most) {
  const rtl::Pipeline fastest = rtl::make_pipeline(graph, library, rtl::shortest_clock_ps(graph, library));
  std::vector<int> clocks{fastest.schedule.clock_ps};
  int stages = fastest.schedule.stages;
  constexpr int slowest = 4;  // times the fastest
  constexpr int steps = 60;
  const std::int64_t range = std::int64_t{slowest - 1} * fastest.schedule.clock_ps;
  for (int step = 1; step <= steps && stages > 1; ++step) {
    const auto clock = static_cast<int>(fastest.schedule.clock_ps + range * step / steps);
    const int needed = rtl::make_pipeline(graph, library, clock).schedule.stages;
    if (needed >= stages) continue;
    stages = needed;
    clocks.push_back(clock);
  }
  if (clocks.size() <= most) return clocks;
  std::vector<int> spread;
  for (std::size_t i = 0; i < most; ++i) spread.push_back(clocks[i * (clocks.size() - 1) / (most - 1)]);
  return spread;
}

}  // namespace hitpipe::sim
