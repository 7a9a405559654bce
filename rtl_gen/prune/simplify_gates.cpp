#include "rtl_gen/prune/facts.hpp"
#include "rtl_gen/prune/passes.hpp"
#include "rtl_gen/prune/rewrite.hpp"

namespace hitpipe::rtl {

namespace {

bool is_constant(const Graph& graph, NodeId id, std::uint64_t pattern) {
  return graph[id].op == Op::constant && graph[id].value == pattern;
}

bool opposite(const Graph& graph, NodeId a, NodeId b) {
  return (graph[a].op == Op::invert && graph[a].args[0] == b) ||
         (graph[b].op == Op::invert && graph[b].args[0] == a);
}

/// The value of a gate with a constant operand; no_node when `fixed` is no constant that decides.
NodeId with_constant(Graph& to, Op op, NodeId fixed, NodeId other) {
  const std::uint64_t all = all_bits(to[other].width);
  if (is_constant(to, fixed, 0)) return op == Op::bit_and ? fixed : other;
  if (!is_constant(to, fixed, all)) return no_node;
  return op == Op::bit_and ? other : op == Op::bit_or ? fixed : to.invert(other);
}

}  // namespace

Graph simplify_gates(const Graph& graph) {
  return rewrite(graph, [&](Graph& to, NodeId id, const NewOperands& operands) {
    const Node& n = graph[id];
    if (n.op != Op::bit_and && n.op != Op::bit_or && n.op != Op::bit_xor) return no_node;
    const auto [a, b, unused] = operands;
    if (a == b) return n.op == Op::bit_xor ? to.constant(n.width, 0) : a;
    if (opposite(to, a, b)) return to.constant(n.width, n.op == Op::bit_and ? 0 : all_bits(n.width));
    if (const NodeId made = with_constant(to, n.op, a, b); made != no_node) return made;
    return with_constant(to, n.op, b, a);
  });
}

}  // namespace hitpipe::rtl
