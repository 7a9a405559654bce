#include <algorithm>

#include "rtl_gen/prune/passes.hpp"
#include "rtl_gen/prune/rewrite.hpp"

namespace hitpipe::rtl {

namespace {

/// Products are left alone: their operands differ in width, and the multiplier is divided by the right one.
bool commutes(Op op) {
  return op == Op::add || op == Op::equal || op == Op::bit_and || op == Op::bit_or || op == Op::bit_xor;
}

}  // namespace

Graph share(const Graph& graph) {
  // The graph records equal nodes once, so it is enough to make them equal.
  return rewrite(graph, [&](Graph& to, NodeId id, const NewOperands& operands) {
    const Node& n = graph[id];
    if (!commutes(n.op)) return no_node;
    const auto [low, high] = std::minmax(operands[0], operands[1]);
    return to.binary(n.op, low, high, n.is_signed);
  });
}

}  // namespace hitpipe::rtl
