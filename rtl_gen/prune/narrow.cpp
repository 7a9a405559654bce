#include <algorithm>
#include <bit>

#include "rtl_gen/prune/analysis.hpp"
#include "rtl_gen/prune/passes.hpp"
#include "rtl_gen/prune/rewrite.hpp"

namespace hitpipe::rtl {

namespace {

/// The bits of a value that must be computed. Those below are known. Those above are known too, or with
/// `by_sign` they repeat the highest computed one.
struct Core {
  int width;  ///< the bits below included
  int low;    ///< how many bits are below
  bool by_sign;
};

Core core_of(const Facts& facts) {
  const int by_bits = std::max(1, facts.unknown_width());
  const bool by_sign = facts.signed_width() <= by_bits;
  const int width = by_sign ? facts.signed_width() : by_bits;
  return {width, std::min(facts.known_low(), width - 1), by_sign};
}

NodeId whole(Graph& to, NodeId made, const Core& core, const Facts& facts) {
  const NodeId low = core.low == 0 ? made : to.concat(made, to.constant(core.low, facts.ones()));
  if (core.by_sign) return to.extend(low, facts.width(), true);
  if (core.width == facts.width()) return low;
  const std::uint64_t above = facts.ones() >> core.width;
  if (above == 0) return to.extend(low, facts.width(), false);
  return to.concat(to.constant(facts.width() - core.width, above), low);
}

class Narrow {
 public:
  Narrow(const Graph& graph, const Demands& demands) : graph_(graph), facts_(analyse(graph, demands)) {}

  [[nodiscard]] Graph made() {
    return rewrite(graph_, [this](Graph& to, NodeId id, const NewOperands& operands) {
      return replace(to, id, operands);
    });
  }

 private:
  NodeId replace(Graph& to, NodeId id, const NewOperands& operands) {
    const Node& n = graph_[id];
    if (!is_root(n.op)) return no_node;
    if (n.op == Op::less || n.op == Op::equal) return comparison(to, id, operands);
    const Core core = core_of(facts_[id]);
    const auto core_bits = [&](NodeId value) { return to.slice(value, core.width - 1, core.low); };
    NodeId made = no_node;
    switch (n.op) {
      case Op::input:
        made = core_bits(operands[0]);
        break;
      case Op::mux: {
        const NodeId if_one = core_bits(operands[1]);
        made = to.mux(operands[0], if_one, core_bits(operands[2]));
        break;
      }
      case Op::add:
      case Op::sub:
        made = core_bits(sum(to, id, operands, core.width));
        break;
      case Op::mul:
        made = core_bits(product(to, id, operands));
        break;
      case Op::call:
        made = core_bits(record_again(to, graph_, id, operands));
        break;
      default: {
        const NodeId left = core_bits(operands[0]);
        made = to.binary(n.op, left, core_bits(operands[1]));
        break;
      }
    }
    name(to, made, id);
    return whole(to, made, core, facts_[id]);
  }

  /// The low bits of a sum or difference. Where one operand ends in zeros, the bits of the other pass
  /// through: there is no carry and no borrow.
  NodeId sum(Graph& to, NodeId id, const NewOperands& operands, int width) {
    const Node& n = graph_[id];
    const auto zeros = [&](std::size_t i) { return std::min(facts_[n.args[i]].low_zeros(), width); };
    const std::size_t passes = n.op == Op::add && zeros(0) > zeros(1) ? 1 : 0;
    const int low = zeros(1 - passes);
    if (low == width) return to.slice(operands[passes], width - 1, 0);
    const NodeId left = to.slice(operands[0], width - 1, low);
    const NodeId made = to.binary(n.op, left, to.slice(operands[1], width - 1, low));
    name(to, made, id);
    return low == 0 ? made : to.concat(made, to.slice(operands[passes], low - 1, 0));
  }

  /// Operands lose the high bits that their numbers do not need and the zeros at their ends. A signed
  /// multiplier stays signed, so each operand keeps a sign bit.
  NodeId product(Graph& to, NodeId id, const NewOperands& operands) {
    const Node& n = graph_[id];
    int zeros = 0;
    const auto fit = [&](std::size_t i) {
      const Facts& f = facts_[n.args[i]];
      const int bits = std::max(1, n.is_signed ? f.signed_width() : 64 - std::countl_zero(f.patterns().high));
      const int low = std::min(f.low_zeros(), bits - 1);
      zeros += low;
      return to.slice(operands[i], bits - 1, low);
    };
    const NodeId left = fit(0);
    const NodeId made = to.binary(Op::mul, left, fit(1), n.is_signed);
    name(to, made, id);
    const NodeId wide = to.extend(made, n.width - zeros, n.is_signed);
    return zeros == 0 ? wide : to.concat(wide, to.constant(zeros, 0));
  }

  /// Compares only the bits in which the operands can differ.
  NodeId comparison(Graph& to, NodeId id, const NewOperands& operands) {
    const Node& n = graph_[id];
    const Facts& a = facts_[n.args[0]];
    const Facts& b = facts_[n.args[1]];
    const int width = a.width();
    const std::uint64_t alike = (a.zeros() & b.zeros()) | (a.ones() & b.ones());
    const int differing = std::max(1, 64 - std::countl_zero(~alike & all_bits(width)));
    const bool keeps_sign = n.op == Op::less && n.is_signed;
    const int by_sign = std::max(a.signed_width(), b.signed_width());
    // When the high bits are equal, the order is that of the unsigned patterns below them.
    const bool as_patterns = differing < width && differing <= by_sign;
    const int bits = as_patterns ? differing : keeps_sign || n.op == Op::equal ? by_sign : width;
    const int low = std::min(std::countr_one(alike), bits - 1);
    const NodeId left = to.slice(operands[0], bits - 1, low);
    return to.binary(n.op, left, to.slice(operands[1], bits - 1, low), keeps_sign && !as_patterns);
  }

  void name(Graph& to, NodeId made, NodeId id) { to.annotate(made, graph_[id].name, graph_[id].source); }

  const Graph& graph_;
  std::vector<Facts> facts_;
};

}  // namespace

Graph narrow(const Graph& graph, const Demands& demands) {
  return Narrow(graph, demands).made();
}

}  // namespace hitpipe::rtl
