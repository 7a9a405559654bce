#include "rtl_gen/pipeline.hpp"

#include "rtl_gen/component/product.hpp"
#include "rtl_gen/graph/canonical.hpp"
#include "rtl_gen/schedule/least_area.hpp"

namespace hitpipe::rtl {

namespace {

SharedSchedule shared_schedule(const Graph& graph, const Library& library, std::optional<int> clock_ps,
                               int interval) {
  Schedule alone = schedule_asap(graph, library, clock_ps);
  if (interval == 1) return {std::move(alone), {}};
  return share_for_least_area(graph, library, interval, sharing_prices(graph, library, alone.clock_ps),
                              clock_ps);
}

}  // namespace

Pipeline make_pipeline(const Graph& traced, const Library& library, std::optional<int> clock_ps,
                       int interval) {
  Graph graph = with_products_planned(canonical(traced), library);
  SharedSchedule shared = shared_schedule(graph, library, clock_ps, interval);
  Placement placement = place_registers(graph, shared.schedule, Ports::latched, interval);
  use_block_registers(placement, graph, shared.schedule, library, shared.binding);
  return {std::move(graph), std::move(shared.schedule), std::move(placement), std::move(shared.binding)};
}

}  // namespace hitpipe::rtl
