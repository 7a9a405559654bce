// Checks the rules of schedule.hpp one by one. It computes arrival times again, from the stages alone.
#include <algorithm>
#include <functional>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "rtl_gen/graph/sources.hpp"
#include "rtl_gen/schedule/chaining.hpp"
#include "rtl_gen/schedule/divided_unit.hpp"
#include "rtl_gen/schedule/schedule.hpp"
#include "rtl_gen/schedule/sharing.hpp"

namespace hitpipe::rtl {

namespace {

std::string label(const Graph& graph, NodeId id) {
  const Node& n = graph[id];
  return n.name.empty() ? fmt::format("%{} ({})", id, op_name(n.op)) : n.name;
}

/// The nodes that read their operands one stage before they work, and the delay of the selection.
struct Selections {
  const Binding* binding = nullptr;
  int delay_ps = 0;
  [[nodiscard]] bool has(NodeId id) const { return binding != nullptr && binding->shares(id); }
};

/// `timing` gives the delay and the internal stages of a node, `ps_per_bit` is the library's.
std::vector<std::string> broken_rules(const Graph& graph, const Schedule& schedule,
                                      const std::function<Cell(NodeId)>& timing, int latch_ps, int ps_per_bit,
                                      const Selections& selections = {}) {
  std::vector<std::string> broken;
  if (schedule.slots.size() != graph.size()) {
    return {fmt::format("{} slots for {} nodes", schedule.slots.size(), graph.size())};
  }
  if (schedule.stages < 1) broken.push_back(fmt::format("{} stages, at least 1 is needed", schedule.stages));
  std::vector<Arrival> arrival(graph.size());  // within the finishing stage, for unlatched values
  for (NodeId id = 0; id < graph.size(); ++id) {
    const Node& n = graph[id];
    const Slot& slot = schedule.slots[id];
    if (!is_root(n.op)) continue;
    if (n.op == Op::input) {
      if (slot.finish != 0 || !slot.latched)
        broken.push_back(fmt::format("input {} is not at stage 0", n.name));
      continue;
    }
    if (slot.stage < 1) broken.push_back(fmt::format("{} starts in stage {}", label(graph, id), slot.stage));
    if (slot.stage < n.min_stage) {
      broken.push_back(fmt::format("{} starts in stage {} but states stage {}", label(graph, id), slot.stage,
                                   n.min_stage));
    }
    const Cell cell = timing(id);
    const bool selects = selections.has(id);
    const int works = slot.stage + (selects ? 1 : 0);
    if (slot.finish != works + std::max(cell.stages, 1) - 1 || slot.latched != (cell.stages > 0)) {
      broken.push_back(fmt::format("{} has {} internal stages{} but occupies stages {} to {}",
                                   label(graph, id), cell.stages, selects ? " and a selection" : "",
                                   slot.stage, slot.finish));
    }
    for_each_source(graph, id, [&](NodeId source, Word) {
      const Slot& from = schedule.slots[source];
      const int usable = from.latched ? from.finish + 1 : from.finish;
      if (usable > slot.stage) {
        broken.push_back(fmt::format("{} starts in stage {} but reads {}, which is there in stage {}",
                                     label(graph, id), slot.stage, label(graph, source), usable));
      }
    });
    const auto chain = [&](const Cell& read_by) {
      return operands_of(graph, id, read_by, ps_per_bit, [&](NodeId source) {
        const Slot& from = schedule.slots[source];
        return from.finish == slot.stage && !from.latched ? arrival[source] : Arrival{};
      });
    };
    if (selects) {
      const int before_ps = chain({}).all_ps + selections.delay_ps;
      if (before_ps + latch_ps > schedule.clock_ps) {
        broken.push_back(
            fmt::format("{}: {} ps of logic before its latched operands and a {} ps latch exceed "
                        "the clock of {} ps",
                        label(graph, id), before_ps, latch_ps, schedule.clock_ps));
      }
    }
    arrival[id] = selects ? result_of(n.op, cell) : result_of(n.op, cell, chain(cell));
    if (arrival[id].all_ps + latch_ps > schedule.clock_ps) {
      broken.push_back(fmt::format("{}: {} ps of logic and a {} ps latch exceed the clock of {} ps",
                                   label(graph, id), arrival[id].all_ps, latch_ps, schedule.clock_ps));
    }
  }
  for (const Output& out : graph.outputs()) {
    for_each_source_of(graph, out.node, [&](NodeId source, Word) {
      if (schedule.slots[source].finish > schedule.stages) {
        broken.push_back(fmt::format("output {} is latched in stage {} but {} is there in stage {}", out.name,
                                     schedule.stages, label(graph, source), schedule.slots[source].finish));
      }
    });
  }
  return broken;
}

/// Whether one component can carry out both operations.
bool one_kind(const Graph& graph, NodeId a, NodeId b) {
  const Node& x = graph[a];
  const Node& y = graph[b];
  bool alike = is_component(x.op) && x.op == y.op && x.width == y.width && x.is_signed == y.is_signed &&
               x.submodule == y.submodule && x.arity() == y.arity();
  for (int i = 0; alike && i < x.arity(); ++i)
    alike = graph[x.operands()[static_cast<std::size_t>(i)]].width ==
            graph[y.operands()[static_cast<std::size_t>(i)]].width;
  return alike;
}

}  // namespace

std::vector<std::string> verify(const Graph& graph, const Library& library, const Schedule& schedule) {
  return broken_rules(graph, schedule, NodeTiming(graph, library, schedule.clock_ps),
                      library.latch_delay_ps(), library.carry_delay_ps_per_bit());
}

std::vector<std::string> verify(const Graph& graph, const Library& library, const Schedule& schedule,
                                const Binding& binding) {
  if (binding.interval < 1) return {fmt::format("an interval of {} cycles", binding.interval)};
  std::size_t most = 1;
  for (const auto& [instance, operations] : binding.instances()) most = std::max(most, operations.size());
  std::vector<std::string> broken = broken_rules(
      graph, schedule, NodeTiming(graph, library, schedule.clock_ps), library.latch_delay_ps(),
      library.carry_delay_ps_per_bit(), {&binding, selection_ps(library, static_cast<int>(most))});
  if (schedule.slots.size() != graph.size()) return broken;
  std::map<std::pair<int, int>, NodeId> taken;  // by instance and phase
  std::map<int, NodeId> first;                  // by instance
  for (const auto& [id, instance] : binding.instance_of) {
    const NodeId of_kind = first.try_emplace(instance, id).first->second;
    if (!one_kind(graph, of_kind, id)) {
      broken.push_back(fmt::format("{} and {} share instance {} but are of different kinds",
                                   label(graph, of_kind), label(graph, id), instance));
    }
    const int phase = schedule.slots[id].stage % binding.interval;
    const auto [other, is_free] = taken.try_emplace({instance, phase}, id);
    if (!is_free) {
      broken.push_back(fmt::format("{} and {} start in stages {} and {} on instance {}, the same modulo {}",
                                   label(graph, other->second), label(graph, id),
                                   schedule.slots[other->second].stage, schedule.slots[id].stage, instance,
                                   binding.interval));
    }
  }
  return broken;
}

std::vector<std::string> verify_stated(const Graph& graph, const Schedule& schedule) {
  return broken_rules(
      graph, schedule, [](NodeId) { return Cell{}; }, 0, 0);
}

}  // namespace hitpipe::rtl
