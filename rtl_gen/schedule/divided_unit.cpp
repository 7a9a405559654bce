#include "rtl_gen/schedule/divided_unit.hpp"

#include <algorithm>
#include <stdexcept>

#include "rtl_gen/component/product.hpp"
#include "rtl_gen/schedule/logic_levels.hpp"
#include "rtl_gen/schedule/registers.hpp"

namespace hitpipe::rtl {

namespace {

const Library& levels() {
  static const Library library = Library::from_json(logic_levels_json, "logic_levels.json");
  return library;
}

/// A clock period in which all the logic fits into one stage.
int whole_delay(const Graph& graph) {
  int sum = levels().latch_delay_ps();
  for (NodeId id = 0; id < graph.size(); ++id) {
    if (is_root(graph[id].op) && graph[id].op != Op::input) sum += timing_of(graph, id, levels()).delay_ps;
  }
  return sum;
}

}  // namespace

Schedule balance(const Graph& graph, int stages) {
  if (stages < 1) throw std::invalid_argument(graph.name() + ": a component has at least one stage");
  // A longer clock needs fewer stages: bisect for the shortest that fits.
  Schedule best = schedule_asap(graph, levels(), whole_delay(graph));
  int too_short = schedule_asap(graph, levels()).clock_ps - 1;
  while (best.clock_ps - too_short > 1) {
    Schedule tried = schedule_asap(graph, levels(), too_short + (best.clock_ps - too_short) / 2);
    if (tried.stages <= stages) {
      best = std::move(tried);
    } else {
      too_short = tried.clock_ps;
    }
  }
  best.stages = stages;
  return best;
}

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

DividedUnit divided(const Submodule& unit, const Library& library, int clock_ps) {
  Graph body = with_products_planned(unit.body, library);
  Schedule schedule = library.chip() != nullptr
                          ? schedule_asap(body, library, clock_ps)
                          : balance(body, std::max(1, timing_of_unit(unit, library).stages));
  Placement placement = place_registers(body, schedule, Ports::direct);
  use_block_registers(placement, body, schedule, library);
  return {std::move(body), std::move(schedule), std::move(placement)};
}

Cell timing_of_unit(const Submodule& unit, const Library& library, std::optional<int> clock_ps) {
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
  for (const auto& unit : graph.submodules()) units_.push_back(timing_of_unit(*unit, library, clock_ps));
}

Cell NodeTiming::operator()(NodeId node) const {
  const Node& n = graph_[node];
  return n.op == Op::call ? units_[static_cast<std::size_t>(n.submodule)] : timing_of(graph_, node, library_);
}

}  // namespace hitpipe::rtl
