#include "rtl_gen/pipeline.hpp"

#include "rtl_gen/graph/canonical.hpp"

namespace hitpipe::rtl {

Pipeline make_pipeline(const Graph& traced, const Library& library, std::optional<int> clock_ps) {
  Graph graph = canonical(traced);
  Schedule schedule = schedule_asap(graph, library, clock_ps);
  Placement placement = place_registers(graph, schedule, Ports::latched);
  return {std::move(graph), std::move(schedule), std::move(placement)};
}

}  // namespace hitpipe::rtl
