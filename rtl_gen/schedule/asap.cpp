#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rtl_gen/graph/sources.hpp"
#include "rtl_gen/schedule/chaining.hpp"
#include "rtl_gen/schedule/divided_unit.hpp"
#include "rtl_gen/schedule/schedule.hpp"

namespace hitpipe::rtl {

namespace {

/// The clock period that the slowest component of the graph needs, latch included, and that component.
struct SlowestStage {
  int clock_ps = 0;
  std::string component = "a latch alone";
};

SlowestStage slowest_stage(const Graph& graph, const Library& library, const NodeTiming& timing) {
  SlowestStage slowest{.clock_ps = library.latch_delay_ps()};
  for (NodeId id = 0; id < graph.size(); ++id) {
    if (!is_root(graph[id].op) || graph[id].op == Op::input) continue;
    const int clock = result_of(graph[id].op, timing(id)).all_ps + library.latch_delay_ps();
    if (clock <= slowest.clock_ps) continue;
    slowest.clock_ps = clock;
    if (is_component(graph[id].op)) {
      const ComponentUse use = component_of(graph, id);
      slowest.component = fmt::format("{}:{}", component_name(use.component), use.bits);
    } else {
      slowest.component = op_name(graph[id].op);
    }
  }
  return slowest;
}

void require_legal(const Graph& graph, const std::vector<std::string>& broken) {
  if (broken.empty()) return;
  throw std::logic_error(fmt::format("{}: illegal schedule: {}", graph.name(), fmt::join(broken, "; ")));
}

}  // namespace

Schedule schedule_asap(const Graph& graph, const Library& library, std::optional<int> clock_ps) {
  const SlowestStage slowest = slowest_stage(graph, library, NodeTiming(graph, library));
  if (clock_ps && *clock_ps < slowest.clock_ps) {
    throw std::invalid_argument(
        fmt::format("{}: a clock of {} ps is too short for {}; the smallest that can be met is {} ps",
                    graph.name(), *clock_ps, slowest.component, slowest.clock_ps));
  }
  Schedule s;
  s.clock_ps = clock_ps.value_or(slowest.clock_ps);
  s.latch_ps = library.latch_delay_ps();
  const NodeTiming timing(graph, library, s.clock_ps);
  s.slots.resize(graph.size());

  for (NodeId id = 0; id < graph.size(); ++id) {
    const Node& n = graph[id];
    Slot& slot = s.slots[id];
    if (n.op == Op::input) slot.latched = true;
    if (!is_root(n.op) || n.op == Op::input) continue;

    const Cell cell = timing(id);
    int stage = earliest_stage(graph, s, id);
    const auto result_in = [&](int in) {
      return result_of(n.op, cell, operands_in(graph, s, id, cell, library.carry_delay_ps_per_bit(), in));
    };
    if (result_in(stage).all_ps + s.latch_ps > s.clock_ps) ++stage;
    const Arrival result = result_in(stage);
    slot.stage = stage;
    slot.latched = cell.stages > 0;
    slot.finish = stage + std::max(cell.stages, 1) - 1;
    slot.ready_ps = slot.latched ? 0 : result.all_ps;
    slot.low_ps = slot.latched ? 0 : result.low_ps;
  }
  s.stages = last_stage(graph, s);
  require_legal(graph, verify(graph, library, s));
  return s;
}

Schedule schedule_as_stated(const Graph& graph, int stages) {
  Schedule s;
  s.stages = stages;
  s.slots.resize(graph.size());
  for (NodeId id = 0; id < graph.size(); ++id) {
    const Node& n = graph[id];
    if (n.op == Op::input) s.slots[id].latched = true;
    if (!is_root(n.op) || n.op == Op::input) continue;
    int stage = std::max(1, n.min_stage);
    for_each_source(graph, id, [&](NodeId source, Word) { stage = std::max(stage, s.slots[source].finish); });
    if (stage > stages) {
      throw std::logic_error(fmt::format("{}: a node states stage {} of {}", graph.name(), stage, stages));
    }
    s.slots[id] = {.stage = stage, .finish = stage};
  }
  require_legal(graph, verify_stated(graph, s));
  return s;
}

}  // namespace hitpipe::rtl
