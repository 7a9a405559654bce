// Follows wires back to the values that can be latched: which of them a node reads, and which of their bits.
#pragma once

#include <vector>

#include "rtl_gen/graph/graph.hpp"

namespace hitpipe::rtl {

/// Calls visit(root, bits) for every input, component or gate from which wires bring the masked bits of
/// `value`.
template <class Visit>
void for_each_source_of(const Graph& graph, NodeId value, Word bits, Visit&& visit) {
  const Node& n = graph[value];
  if (bits == 0 || n.op == Op::constant) return;
  switch (n.op) {
    case Op::slice:
      for_each_source_of(graph, n.args[0], bits << n.low, visit);
      break;
    case Op::invert:
      for_each_source_of(graph, n.args[0], bits, visit);
      break;
    case Op::concat: {
      const int split = graph[n.args[1]].width;
      for_each_source_of(graph, n.args[1], bits & bit_range(split - 1, 0), visit);
      for_each_source_of(graph, n.args[0], bits >> split, visit);
      break;
    }
    case Op::extend: {
      const int source = graph[n.args[0]].width;
      Word low = bits & bit_range(source - 1, 0);
      if (n.is_signed && (bits & ~bit_range(source - 1, 0)) != 0) low |= Word{1} << (source - 1);
      for_each_source_of(graph, n.args[0], low, visit);
      break;
    }
    default:
      visit(value, bits);
      break;
  }
}

template <class Visit>
void for_each_source_of(const Graph& graph, NodeId value, Visit&& visit) {
  for_each_source_of(graph, value, bit_range(graph[value].width - 1, 0), visit);
}

/// The same for all operands of a node.
template <class Visit>
void for_each_source(const Graph& graph, NodeId node, Visit&& visit) {
  for (const NodeId arg : graph[node].operands()) for_each_source_of(graph, arg, visit);
}

/// What wires make of the roots behind a value: the same of two values whose roots they treat alike.
[[nodiscard]] inline std::vector<int> wires_to(const Graph& graph, NodeId value) {
  const Node& n = graph[value];
  if (is_root(n.op)) return {-1};
  if (n.op == Op::constant) return {static_cast<int>(value)};
  std::vector<int> wires{static_cast<int>(n.op), n.width, n.low, n.is_signed ? 1 : 0};
  for (const NodeId arg : n.operands()) {
    const std::vector<int> inner = wires_to(graph, arg);
    wires.insert(wires.end(), inner.begin(), inner.end());
  }
  return wires;
}

}  // namespace hitpipe::rtl
