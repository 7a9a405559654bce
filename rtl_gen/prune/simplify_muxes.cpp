#include <optional>

#include "rtl_gen/prune/analysis.hpp"
#include "rtl_gen/prune/passes.hpp"
#include "rtl_gen/prune/rewrite.hpp"

namespace hitpipe::rtl {

namespace {

std::optional<bool> constant_bit(const Graph& graph, NodeId id) {
  const Node& n = graph[id];
  if (n.op != Op::constant || n.width != 1) return std::nullopt;
  return n.value != 0;
}

/// A one-bit multiplexer with a constant arm.
NodeId as_gate(Graph& to, NodeId select, NodeId if_one, NodeId if_zero) {
  if (const auto one = constant_bit(to, if_one)) {
    return *one ? to.binary(Op::bit_or, select, if_zero) : to.binary(Op::bit_and, to.invert(select), if_zero);
  }
  if (const auto zero = constant_bit(to, if_zero)) {
    return *zero ? to.binary(Op::bit_or, to.invert(select), if_one) : to.binary(Op::bit_and, select, if_one);
  }
  return no_node;
}

/// The value of an arm while the select has the given value.
NodeId while_select_is(bool value, NodeId select, const Graph& to, NodeId arm) {
  while (to[arm].op == Op::mux && to[arm].args[0] == select) arm = to[arm].args[value ? 1 : 2];
  return arm;
}

}  // namespace

Graph simplify_muxes(const Graph& graph, const Demands& demands) {
  const std::vector<Facts> facts = analyse(graph, demands);
  return rewrite(graph, [&](Graph& to, NodeId id, const NewOperands& operands) {
    const Node& n = graph[id];
    if (n.op != Op::mux) return no_node;
    const Facts& select = facts[n.args[0]];
    if (select.is_constant()) return operands[select.pattern() != 0 ? 1 : 2];
    const NodeId if_one = while_select_is(true, operands[0], to, operands[1]);
    const NodeId if_zero = while_select_is(false, operands[0], to, operands[2]);
    if (if_one == if_zero) return if_one;
    if (const NodeId gate = as_gate(to, operands[0], if_one, if_zero); gate != no_node) return gate;
    return to.mux(operands[0], if_one, if_zero);
  });
}

}  // namespace hitpipe::rtl
