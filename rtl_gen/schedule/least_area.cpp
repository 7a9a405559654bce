#include "rtl_gen/schedule/least_area.hpp"

#include <algorithm>
#include <utility>

#include "rtl_gen/schedule/divided_unit.hpp"
#include "rtl_gen/schedule/registers.hpp"

namespace hitpipe::rtl {

namespace {

std::int64_t sharing_price(const Cell& cell, const Library& library) {
  if (library.chip() == nullptr) return cell.area_um2;
  const std::int64_t block = library.chip()->block ? library.chip()->block->luts : 0;
  return cell.taken.luts + cell.taken.registers + cell.taken.blocks * block;
}

std::int64_t sharing_price(const Graph& graph, NodeId id, const Library& library, int clock_ps);

/// A chip has no price of a unit: it is the price of the unit's inside.
std::int64_t sharing_price_inside(const Submodule& unit, const Library& library, int clock_ps) {
  const DividedUnit inside = divided(unit, library, clock_ps);
  std::int64_t price = 0;
  for (NodeId id = 0; id < inside.body.size(); ++id) {
    const Op op = inside.body[id].op;
    if (is_root(op) && op != Op::input) price += sharing_price(inside.body, id, library, clock_ps);
  }
  for (const Register& r : inside.placement.registers)
    if (!r.in_block) price += sharing_price(library.cell(Component::latch, r.width()), library);
  return price;
}

std::int64_t sharing_price(const Graph& graph, NodeId id, const Library& library, int clock_ps) {
  const Node& n = graph[id];
  if (!is_component(n.op)) {
    return library.chip() == nullptr ? 0 : sharing_price(library.cell(Component::gate, n.width), library);
  }
  if (n.op == Op::call && library.chip() != nullptr)
    return sharing_price_inside(*graph.submodule_of(id), library, clock_ps);
  const ComponentUse use = component_of(graph, id);
  const std::int64_t price = sharing_price(library.cell(use.component, use.bits), library);
  if (n.op != Op::mul || library.chip() != nullptr) return price;
  // An array has one row of partial products for each bit of the narrower operand.
  const int narrower = std::min(graph[n.args[0]].width, graph[n.args[1]].width);
  return (2 * price * narrower + use.bits) / (std::int64_t{2} * use.bits);
}

/// The latches of an instance's operands, and the multiplexers before them.
std::int64_t selection_price(const Graph& graph, const SharedSchedule& shared, const RegisterTable& registers,
                             const std::vector<NodeId>& operations, const SharingPrices& prices) {
  std::int64_t price = 0;
  const Node& first = graph[operations.front()];
  for (std::size_t i = 0; i < first.operands().size(); ++i) {
    const NodeId arg = first.args[i];
    if (!is_selected(graph, operations, i)) continue;
    price += prices.part(Component::latch, graph[arg].width);
    const int values = selected_values(graph, shared, registers, operations, i);
    price += (values - 1) * prices.part(Component::mux2, graph[arg].width);
  }
  return price;
}

struct TriedSharing {
  SharedSchedule shared;
  std::int64_t area;
};

}  // namespace

SharingPrices sharing_prices(const Graph& graph, const Library& library, int clock_ps) {
  std::vector<std::int64_t> operations(graph.size(), 0);
  for (NodeId id = 0; id < graph.size(); ++id)
    if (is_component(graph[id].op)) operations[id] = sharing_price(graph, id, library, clock_ps);
  return {.part = [&library](Component component,
                             int bits) { return sharing_price(library.cell(component, bits), library); },
          .operation = [operations = std::move(operations)](NodeId id) { return operations.at(id); }};
}

std::int64_t area_of(const Graph& graph, const SharedSchedule& shared, const SharingPrices& prices) {
  const auto& [schedule, binding] = shared;
  std::int64_t area = 0;
  for (NodeId id = 0; id < graph.size(); ++id)
    if (is_component(graph[id].op) && !binding.shares(id)) area += prices.operation(id);
  const Placement placement = place_registers(graph, schedule, Ports::latched, binding);
  const RegisterTable registers(placement, binding.interval);
  for (const auto& [instance, operations] : binding.instances())
    area +=
        prices.operation(operations.front()) + selection_price(graph, shared, registers, operations, prices);
  for (const Register& r : placement.registers) area += prices.part(Component::latch, r.width());
  const int tags = schedule.stages / binding.interval + 1;
  return area + (schedule.stages + 1) * prices.part(Component::latch, 1) +
         tags * prices.part(Component::latch, prices.tag_bits);
}

SharedSchedule share_for_least_area(const Graph& graph, const Library& library, int interval,
                                    const SharingPrices& prices, std::optional<int> clock_ps,
                                    int longest_wait) {
  SharingProblem problem{.graph = graph,
                         .library = library,
                         .interval = interval,
                         .groups = {},
                         .clock_ps = clock_ps,
                         .earliest = std::vector<int>(graph.size(), 0)};
  const auto tried = [&](std::vector<SharingGroup> groups) {
    std::erase_if(groups, [](const SharingGroup& group) { return group.operations.empty(); });
    problem.groups = std::move(groups);
    TriedSharing made{schedule_modulo(problem), 0};
    made.area = area_of(graph, made.shared, prices);
    return made;
  };
  TriedSharing best = tried({});
  if (interval == 1) return std::move(best.shared);

  std::vector<SharingGroup> kinds = kinds_of(graph);
  // A shared multiplexer would need others before it.
  std::erase_if(kinds,
                [&](const SharingGroup& kind) { return graph[kind.operations.front()].op == Op::mux; });
  const auto worth = [&](const SharingGroup& kind) {
    return static_cast<std::int64_t>(kind.operations.size()) * prices.operation(kind.operations.front());
  };
  std::stable_sort(kinds.begin(), kinds.end(),
                   [&](const SharingGroup& a, const SharingGroup& b) { return worth(a) > worth(b); });
  const auto selects_too_slowly = [&, clock = best.shared.schedule.clock_ps](const SharingGroup& group) {
    return selection_ps(library, most_operations(group, interval)) + library.latch_delay_ps() > clock;
  };
  std::vector<SharingGroup> chosen(kinds.size());
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
      const std::vector<NodeId>& all = kinds[kind].operations;
      const auto count = static_cast<int>(all.size());
      for (int instances = 0; 2 * instances <= count; ++instances) {
        // Operations that find no place in the shared instances keep their own. More instances than these
        // need can be smaller too: operations wait for less time, so fewer values are latched.
        const int sharing = std::min(count, instances * interval);
        if (sharing == 1) continue;
        std::vector<SharingGroup> groups = chosen;
        groups[kind] = {{all.begin(), all.begin() + sharing}, instances};
        if (instances > 0 && selects_too_slowly(groups[kind])) continue;
        TriedSharing next = tried(groups);
        if (next.area >= best.area) continue;
        best = std::move(next);
        chosen = std::move(groups);
        changed = true;
      }
    }
  }
  // An operation may wait for as long as that leaves fewer bits in registers.
  for (bool changed = true; changed;) {
    changed = false;
    for (NodeId id = 0; id < graph.size(); ++id) {
      if (!is_component(graph[id].op)) continue;
      const int before = problem.earliest[id];
      const int stage = best.shared.schedule.slots[id].stage;
      bool better = false;
      for (int wait = 1; wait <= longest_wait && !better; ++wait) {
        problem.earliest[id] = stage + wait;
        TriedSharing next = tried(chosen);
        better = next.area < best.area;
        if (better) best = std::move(next);
      }
      if (!better) problem.earliest[id] = before;
      changed |= better;
    }
  }
  return std::move(best.shared);
}

}  // namespace hitpipe::rtl
