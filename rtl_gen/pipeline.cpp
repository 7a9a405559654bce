#include "rtl_gen/pipeline.hpp"

#include "rtl_gen/component/product.hpp"
#include "rtl_gen/graph/canonical.hpp"
#include "rtl_gen/schedule/wider.hpp"

namespace hitpipe::rtl {

namespace {

Graph planned_graph(const Graph& traced, const Library& library, int interval) {
  return with_products_planned(canonical(traced), library, interval);
}

}  // namespace

Pipeline make_pipeline(const Graph& traced, const Library& library, std::optional<int> clock_ps,
                       int interval) {
  const Graph planned = planned_graph(traced, library, interval);
  auto [graph, shared] = interval == 1 ? SharedGraph{planned, {schedule_asap(planned, library, clock_ps), {}}}
                                       : share_widened(planned, library, interval, clock_ps);
  Placement placement = place_registers(graph, shared.schedule, Ports::latched, shared.binding);
  use_block_registers(placement, graph, shared.schedule, library, shared.binding);
  return {std::move(graph), std::move(shared.schedule), std::move(placement), std::move(shared.binding)};
}

int own_clock_ps(const Graph& traced, const Library& library, int interval) {
  return schedule_asap(planned_graph(traced, library, interval), library).clock_ps;
}

}  // namespace hitpipe::rtl
