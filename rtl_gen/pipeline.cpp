#include "rtl_gen/pipeline.hpp"

#include "rtl_gen/component/product.hpp"
#include "rtl_gen/graph/canonical.hpp"
#include "rtl_gen/schedule/kept_searches.hpp"
#include "rtl_gen/schedule/least_area.hpp"

namespace hitpipe::rtl {

namespace {

Graph planned_graph(const Graph& traced, const Library& library, int interval) {
  return with_products_planned(canonical(traced), library, interval);
}

/// How much longer the usual clock may be than the shortest.
constexpr int most_longer_pct = 25;

/// The shortest clock. Where a register takes a cell of its own it is the one whose product of cells and time
/// is the smallest.
int usual_clock_ps(const Graph& planned, const Library& library) {
  const Schedule fastest = schedule_asap(planned, library);
  if (library.chip() == nullptr || !library.chip()->packs_registers) return fastest.clock_ps;
  const auto cells_times_time = [&](const Schedule& schedule) {
    const SharingPrices prices = sharing_prices(planned, library, schedule.clock_ps);
    return area_of(planned, {schedule, {}}, prices) * schedule.clock_ps;
  };
  int clock = fastest.clock_ps;
  int stages = fastest.stages;
  std::int64_t least = cells_times_time(fastest);
  for (int longer_pct = 1; longer_pct <= most_longer_pct; ++longer_pct) {
    const Schedule next = schedule_asap(planned, library, fastest.clock_ps * (100 + longer_pct) / 100);
    if (next.stages >= stages) continue;
    stages = next.stages;
    const std::int64_t taken = cells_times_time(next);
    if (taken >= least) continue;
    least = taken;
    clock = next.clock_ps;
  }
  return clock;
}

/// A core has a few of them, and its fit tries some tens.
KeptSearches& kept_searches() {
  static KeptSearches all(32);
  return all;
}

}  // namespace

Pipeline make_pipeline(const Graph& traced, const Library& library, std::optional<int> clock_ps,
                       int interval) {
  const Graph planned = planned_graph(traced, library, interval);
  if (!clock_ps) clock_ps = usual_clock_ps(planned, library);
  auto [graph, shared] = interval == 1 ? SharedGraph{planned, {schedule_asap(planned, library, clock_ps), {}}}
                                       : kept_searches().share(planned, library, interval, clock_ps);
  Placement placement = place_registers(graph, shared.schedule, Ports::latched, shared.binding);
  use_block_registers(placement, graph, shared.schedule, library, shared.binding);
  drop_needless_enables(placement, graph, shared.schedule, shared.binding);
  return {std::move(graph), std::move(shared.schedule), std::move(placement), std::move(shared.binding)};
}

int shortest_clock_ps(const Graph& traced, const Library& library, int interval) {
  return schedule_asap(planned_graph(traced, library, interval), library).clock_ps;
}

}  // namespace hitpipe::rtl
