// The passes that replace single nodes by a rule, in the order in which prune() runs them.
#include <algorithm>
#include <bit>
#include <optional>
#include <vector>

#include "rtl_gen/graph/rewrite.hpp"
#include "rtl_gen/prune/facts.hpp"
#include "rtl_gen/prune/prune.hpp"

namespace hitpipe::rtl {

namespace {

std::optional<bool> constant_bit(const Graph& graph, NodeId id) {
  const Node& n = graph[id];
  if (n.op != Op::constant || n.width != 1) return std::nullopt;
  return n.value != 0;
}

/// A one-bit multiplexer with a constant arm.
NodeId as_gate(Graph& to, NodeId select, NodeId if_one, NodeId if_zero) {
  if (const auto one = constant_bit(to, if_one))
    return *one ? to.binary(Op::bit_or, select, if_zero) : to.binary(Op::bit_and, to.invert(select), if_zero);
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

bool is_constant(const Graph& graph, NodeId id, Word pattern) {
  return graph[id].op == Op::constant && graph[id].value == pattern;
}

bool opposite(const Graph& graph, NodeId a, NodeId b) {
  return (graph[a].op == Op::invert && graph[a].args[0] == b) ||
         (graph[b].op == Op::invert && graph[b].args[0] == a);
}

/// The value of a gate with a constant operand; no_node when `fixed` is no constant that decides.
NodeId with_constant(Graph& to, Op op, NodeId fixed, NodeId other) {
  const Word all = ones_below(to[other].width);
  if (is_constant(to, fixed, 0)) return op == Op::bit_and ? fixed : other;
  if (!is_constant(to, fixed, all)) return no_node;
  return op == Op::bit_and ? other : op == Op::bit_or ? fixed : to.invert(other);
}

/// A product with the constant 0, or with a power of two that the multiplier reads as positive.
NodeId shifted(Graph& to, const Node& mul, NodeId fixed, NodeId other) {
  const Node factor = to[fixed];
  if (factor.op != Op::constant) return no_node;
  if (factor.value == 0) return to.constant(mul.width, 0);
  if (count_of_ones(factor.value) != 1) return no_node;
  if (mul.is_signed && number_of(factor.value, factor.width) < 0) return no_node;
  const int shift = low_zeros(factor.value);
  const NodeId wide = to.extend(other, mul.width, mul.is_signed);
  return shift == 0 ? wide : to.concat(to.slice(wide, mul.width - 1 - shift, 0), to.constant(shift, 0));
}

/// Products are left alone: their operands differ in width, and the multiplier is divided by the right one.
bool commutes(Op op) {
  return op == Op::add || op == Op::equal || op == Op::bit_and || op == Op::bit_or || op == Op::bit_xor;
}

}  // namespace

Graph fold_constants(const Graph& graph, const Demands& demands) {
  const std::vector<Facts> facts = analyse(graph, demands);
  return rewrite(graph, [&](Graph& to, NodeId id, const NewOperands&) {
    const Node& n = graph[id];
    const bool compares = n.op == Op::less || n.op == Op::equal;
    return facts[id].is_constant() && !compares ? to.constant(n.width, facts[id].pattern()) : no_node;
  });
}

Graph decide_comparisons(const Graph& graph, const Demands& demands) {
  const std::vector<Facts> facts = analyse(graph, demands);
  return rewrite(graph, [&](Graph& to, NodeId id, const NewOperands& operands) {
    const Node& n = graph[id];
    if (n.op != Op::less && n.op != Op::equal) return no_node;
    if (facts[id].is_constant()) return to.constant(1, facts[id].pattern());
    // This x < 0 is signed: an unsigned one was decided above.
    const Facts& right = facts[n.args[1]];
    if (n.op == Op::less && right.is_constant() && right.pattern() == 0) {
      const int sign = right.width() - 1;
      return to.slice(operands[0], sign, sign);
    }
    return no_node;
  });
}

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

Graph simplify_gates(const Graph& graph) {
  return rewrite(graph, [&](Graph& to, NodeId id, const NewOperands& operands) {
    const Node& n = graph[id];
    if (n.op != Op::bit_and && n.op != Op::bit_or && n.op != Op::bit_xor) return no_node;
    const auto [a, b, unused] = operands;
    if (a == b) return n.op == Op::bit_xor ? to.constant(n.width, 0) : a;
    if (opposite(to, a, b)) return to.constant(n.width, n.op == Op::bit_and ? Word{0} : ones_below(n.width));
    if (const NodeId made = with_constant(to, n.op, a, b); made != no_node) return made;
    return with_constant(to, n.op, b, a);
  });
}

Graph simplify_arithmetic(const Graph& graph) {
  return rewrite(graph, [&](Graph& to, NodeId id, const NewOperands& operands) {
    const Node& n = graph[id];
    const auto [a, b, unused] = operands;
    if (n.op == Op::sub && a == b) return to.constant(n.width, 0);
    if ((n.op == Op::sub || n.op == Op::add) && is_constant(to, b, 0)) return a;
    if (n.op == Op::add && is_constant(to, a, 0)) return b;
    if (n.op != Op::mul) return no_node;
    if (const NodeId made = shifted(to, n, a, b); made != no_node) return made;
    return shifted(to, n, b, a);
  });
}

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
