#include "rtl_gen/pipeline.hpp"

#include "rtl_gen/component/product.hpp"
#include "rtl_gen/graph/canonical.hpp"
#include "rtl_gen/schedule/registers.hpp"

namespace hitpipe::rtl {

Pipeline make_pipeline(const Graph& traced, const Library& library, std::optional<int> clock_ps) {
  Graph graph = with_products_planned(canonical(traced), library);
  Schedule schedule = schedule_asap(graph, library, clock_ps);
  Placement placement = place_registers(graph, schedule, Ports::latched);
  use_block_registers(placement, graph, schedule, library);
  return {std::move(graph), std::move(schedule), std::move(placement)};
}

}  // namespace hitpipe::rtl
