#include "rtl_gen/schedule/divided_unit.hpp"

#include "rtl_gen/component/product.hpp"
#include "rtl_gen/schedule/balance.hpp"
#include "rtl_gen/schedule/block_registers.hpp"

namespace hitpipe::rtl {

DividedUnit divided(const Unit& unit, int stages, const Library& library) {
  Graph body = with_products_planned(unit.body, library);
  Schedule schedule = library.chip() != nullptr ? schedule_asap(body, library) : balance(body, stages);
  Placement placement = place_registers(body, schedule, Ports::direct);
  use_block_registers(placement, body, schedule, library);
  return {std::move(body), std::move(schedule), std::move(placement)};
}

Cell timing_of_unit(const Unit& unit, const Library& library) {
  if (library.chip() == nullptr) return library.timing(component_called(unit.component), unit.bits);
  const Schedule schedule = schedule_asap(with_products_planned(unit.body, library), library);
  return {.bits = unit.bits,
          .delay_ps = schedule.clock_ps - schedule.latch_ps,
          .stages = schedule.stages,
          .estimated = true};
}

NodeTiming::NodeTiming(const Graph& graph, const Library& library) : graph_(graph), library_(library) {
  for (const auto& unit : graph.units()) units_.push_back(timing_of_unit(*unit, library));
}

Cell NodeTiming::operator()(NodeId node) const {
  const Node& n = graph_[node];
  return n.op == Op::call ? units_[static_cast<std::size_t>(n.unit)] : timing_of(graph_, node, library_);
}

}  // namespace hitpipe::rtl
