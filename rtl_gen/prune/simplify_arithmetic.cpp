#include <bit>

#include "rtl_gen/prune/facts.hpp"
#include "rtl_gen/prune/passes.hpp"
#include "rtl_gen/prune/rewrite.hpp"

namespace hitpipe::rtl {

namespace {

bool is_zero(const Graph& graph, NodeId id) {
  return graph[id].op == Op::constant && graph[id].value == 0;
}

/// A product with the constant 0, or with a power of two that the multiplier reads as positive.
NodeId shifted(Graph& to, const Node& mul, NodeId fixed, NodeId other) {
  const Node factor = to[fixed];
  if (factor.op != Op::constant) return no_node;
  if (factor.value == 0) return to.constant(mul.width, 0);
  if (!std::has_single_bit(factor.value)) return no_node;
  if (mul.is_signed && number_of(factor.value, factor.width) < 0) return no_node;
  const int shift = std::countr_zero(factor.value);
  const NodeId wide = to.extend(other, mul.width, mul.is_signed);
  return shift == 0 ? wide : to.concat(to.slice(wide, mul.width - 1 - shift, 0), to.constant(shift, 0));
}

}  // namespace

Graph simplify_arithmetic(const Graph& graph) {
  return rewrite(graph, [&](Graph& to, NodeId id, const NewOperands& operands) {
    const Node& n = graph[id];
    const auto [a, b, unused] = operands;
    if (n.op == Op::sub && a == b) return to.constant(n.width, 0);
    if ((n.op == Op::sub || n.op == Op::add) && is_zero(to, b)) return a;
    if (n.op == Op::add && is_zero(to, a)) return b;
    if (n.op != Op::mul) return no_node;
    if (const NodeId made = shifted(to, n, a, b); made != no_node) return made;
    return shifted(to, n, b, a);
  });
}

}  // namespace hitpipe::rtl
