// Copies a graph node by node; a pass may replace each node.
#pragma once

#include <array>

#include "rtl_gen/graph/graph.hpp"

namespace hitpipe::rtl {

/// The operands of a node in the new graph; for an input, the first is the input itself.
using NewOperands = std::array<NodeId, 3>;

/// Records the node `id` of `from`, which is no input, with other operands.
NodeId record_again(Graph& to, const Graph& from, NodeId id, const NewOperands& operands);

/// `replace(to, id, operands)` returns the node that stands for `id` of `from`, or no_node to copy it.
/// `port(to, id)` makes the node that stands for an input; `replace` is then called with that node. Names are
/// kept.
template <class Port, class Replace>
[[nodiscard]] Graph rewrite(const Graph& from, Port&& port, Replace&& replace) {
  Graph to(from.name());
  std::vector<NodeId> made(from.size(), no_node);
  for (const NodeId id : from.inputs()) made[id] = port(to, id);
  for (NodeId id = 0; id < from.size(); ++id) {
    const Node& n = from[id];
    NewOperands operands{made[id], no_node, no_node};
    for (std::size_t i = 0; i < n.operands().size(); ++i) operands[i] = made[n.args[i]];
    to.begin_stage(n.min_stage);
    const NodeId instead = replace(to, id, operands);
    if (instead != no_node) {
      made[id] = instead;
    } else if (n.op != Op::input) {
      made[id] = record_again(to, from, id, operands);
    }
    if (n.op == Op::input) continue;
    if (instead == no_node) {
      to.annotate_as(made[id], n);
    } else {
      to.annotate(made[id], n.name, n.source);
    }
  }
  for (const Output& out : from.outputs()) to.output(out.name, made[out.node]);
  return to;
}

/// The same, with the ports copied.
template <class Replace>
[[nodiscard]] Graph rewrite(const Graph& from, Replace&& replace) {
  return rewrite(
      from, [&](Graph& to, NodeId id) { return to.input(from[id].name, from[id].width, from[id].is_signed); },
      replace);
}

}  // namespace hitpipe::rtl
