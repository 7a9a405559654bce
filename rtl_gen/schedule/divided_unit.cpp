#include "rtl_gen/schedule/divided_unit.hpp"

#include <algorithm>

#include "rtl_gen/component/product.hpp"
#include "rtl_gen/schedule/balance.hpp"
#include "rtl_gen/schedule/block_registers.hpp"

namespace hitpipe::rtl {

namespace {

/// The time that the slowest stage works.
int slowest_stage_ps(const Graph& graph, const Schedule& schedule, const Library& library) {
  int slowest = 0;
  for (NodeId id = 0; id < graph.size(); ++id) {
    if (!is_root(graph[id].op) || graph[id].op == Op::input) continue;
    const Slot& slot = schedule.slots[id];
    slowest = std::max(slowest, slot.latched ? timing_of(graph, id, library).delay_ps : slot.ready_ps);
  }
  return slowest;
}

}  // namespace

DividedUnit divided(const Unit& unit, const Library& library, int clock_ps) {
  Graph body = with_products_planned(unit.body, library);
  Schedule schedule = library.chip() != nullptr
                          ? schedule_asap(body, library, clock_ps)
                          : balance(body, std::max(1, timing_of_unit(unit, library).stages));
  Placement placement = place_registers(body, schedule, Ports::direct);
  use_block_registers(placement, body, schedule, library);
  return {std::move(body), std::move(schedule), std::move(placement)};
}

Cell timing_of_unit(const Unit& unit, const Library& library, std::optional<int> clock_ps) {
  if (library.chip() == nullptr) return library.timing(component_called(unit.component), unit.bits);
  const Graph body = with_products_planned(unit.body, library);
  const Schedule schedule = schedule_asap(body, library, clock_ps);
  return {.bits = unit.bits,
          .delay_ps = slowest_stage_ps(body, schedule, library),
          .stages = schedule.stages,
          .estimated = true};
}

NodeTiming::NodeTiming(const Graph& graph, const Library& library, std::optional<int> clock_ps)
    : graph_(graph), library_(library) {
  for (const auto& unit : graph.units()) units_.push_back(timing_of_unit(*unit, library, clock_ps));
}

Cell NodeTiming::operator()(NodeId node) const {
  const Node& n = graph_[node];
  return n.op == Op::call ? units_[static_cast<std::size_t>(n.unit)] : timing_of(graph_, node, library_);
}

}  // namespace hitpipe::rtl
