// When the operands of a node are there.
#pragma once

#include <algorithm>

#include "rtl_gen/graph/sources.hpp"
#include "rtl_gen/schedule/schedule.hpp"

namespace hitpipe::rtl {

/// When a value is there, within a stage: its lowest bit, and all of them. Bit i of a carry chain is there
/// `i` times the chain's delay of a bit after the lowest, or with all.
struct Arrival {
  int low_ps = 0;
  int all_ps = 0;

  /// The bits from one on, of which wires make the lowest.
  [[nodiscard]] Arrival from_bit(int bit, int ps_per_bit) const {
    return {std::min(all_ps, low_ps + bit * ps_per_bit), all_ps};
  }
  [[nodiscard]] Arrival after(int ps) const { return {low_ps + ps, all_ps + ps}; }
  [[nodiscard]] Arrival later(const Arrival& other) const {
    return {std::max(low_ps, other.low_ps), std::max(all_ps, other.all_ps)};
  }
};

/// When the operands of a node are there. `arrival_of` says it of a root in the node's stage; of a value out
/// of a latch it is {}. Tables invert a subtrahend. If a table makes it, that table inverts it too.
template <class ArrivalOf>
[[nodiscard]] Arrival operands_of(const Graph& graph, NodeId id, const Cell& cell, int ps_per_bit,
                                  ArrivalOf&& arrival_of) {
  Arrival all;
  const auto operands = graph[id].operands();
  for (std::size_t i = 0; i < operands.size(); ++i) {
    for_each_source_of(graph, operands[i], [&](NodeId source, Word bits) {
      Arrival from = arrival_of(source).from_bit(low_zeros(bits), ps_per_bit);
      const Op op = graph[source].op;
      const bool of_table = op == Op::mux || op == Op::bit_and || op == Op::bit_or || op == Op::bit_xor;
      if (i == 1 && (!of_table || from.all_ps == 0)) from = from.after(cell.subtrahend_ps);
      all = all.later(from);
    });
  }
  return all;
}

/// When the result of a component or gate is there. `operands` says when its operands are.
[[nodiscard]] inline Arrival result_of(Op op, const Cell& cell, const Arrival& operands) {
  const int beside_ripple = cell.delay_ps - cell.ripple_ps;
  const int all = std::max(operands.low_ps + cell.delay_ps, operands.all_ps + beside_ripple);
  switch (op) {
    case Op::add:
    case Op::sub:
      return {operands.low_ps + beside_ripple, all};
    case Op::less:
    case Op::equal:
      return {all, all};
    case Op::mux:
    case Op::bit_and:
    case Op::bit_or:
    case Op::bit_xor:
      return operands.after(cell.delay_ps);
    default:
      return {operands.all_ps + cell.delay_ps, operands.all_ps + cell.delay_ps};
  }
}

/// The same, of operands out of latches.
[[nodiscard]] inline Arrival result_of(Op op, const Cell& cell) {
  return result_of(op, cell, Arrival{}.after(cell.subtrahend_ps));
}

/// The first stage in which a node can start. The slots of its operands are known.
[[nodiscard]] inline int earliest_stage(const Graph& graph, const Schedule& schedule, NodeId id) {
  int stage = std::max(1, graph[id].min_stage);
  for_each_source(graph, id, [&](NodeId source, Word) {
    const Slot& from = schedule.slots[source];
    stage = std::max(stage, from.latched ? from.finish + 1 : from.finish);
  });
  return stage;
}

/// When a node's operands are there in a stage.
[[nodiscard]] inline Arrival operands_in(const Graph& graph, const Schedule& schedule, NodeId id,
                                         const Cell& cell, int ps_per_bit, int stage) {
  return operands_of(graph, id, cell, ps_per_bit, [&](NodeId source) {
    const Slot& from = schedule.slots[source];
    return from.latched || from.finish < stage ? Arrival{} : Arrival{from.low_ps, from.ready_ps};
  });
}

/// The stage that latches the last output.
[[nodiscard]] inline int last_stage(const Graph& graph, const Schedule& schedule) {
  int last = 1;
  for (const Output& out : graph.outputs())
    for_each_source_of(graph, out.node,
                       [&](NodeId source, Word) { last = std::max(last, schedule.slots[source].finish); });
  return last;
}

}  // namespace hitpipe::rtl
