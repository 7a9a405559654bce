#include <algorithm>
#include <bit>

#include "rtl_gen/prune/analysis.hpp"
#include "rtl_gen/prune/passes.hpp"
#include "rtl_gen/prune/rewrite.hpp"

namespace hitpipe::rtl {

namespace {

/// How a value comes back from its low bits: the bits above are known, or repeat the highest of them.
struct Core {
  int width;
  bool by_sign;
};

Core core_of(const Facts& facts) {
  const int by_bits = std::max(1, facts.unknown_width());
  return by_bits < facts.signed_width() ? Core{by_bits, false} : Core{facts.signed_width(), true};
}

NodeId widened(Graph& to, NodeId low, const Core& core, const Facts& facts) {
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
    const NodeId whole = n.op == Op::mul ? product(to, id, operands) : no_node;
    const Core core = core_of(facts_[id]);
    if (core.width == n.width) return whole;
    NodeId low = no_node;
    const auto cut = [&](std::size_t i) { return to.slice(operands[i], core.width - 1, 0); };
    switch (n.op) {
      case Op::input:
        low = cut(0);
        break;
      case Op::mux:
        low = to.mux(operands[0], cut(1), cut(2));
        break;
      case Op::mul:
        low = to.slice(whole, core.width - 1, 0);
        break;
      case Op::call:
        low = to.slice(record_again(to, graph_, id, operands), core.width - 1, 0);
        break;
      default:
        low = to.binary(n.op, cut(0), cut(1));
        break;
    }
    name(to, low, id);
    return widened(to, low, core, facts_[id]);
  }

  /// Of operands that fit theirs; the sign of the multiplier stays, and so does a place for it.
  NodeId product(Graph& to, NodeId id, const NewOperands& operands) {
    const Node& n = graph_[id];
    const auto fit = [&](std::size_t i) {
      const Facts& f = facts_[n.args[i]];
      const int bits = n.is_signed ? f.signed_width() : 64 - std::countl_zero(f.patterns().high);
      return to.slice(operands[i], std::max(1, bits) - 1, 0);
    };
    const NodeId left = fit(0);
    const NodeId made = to.binary(Op::mul, left, fit(1), n.is_signed);
    name(to, made, id);
    return to.extend(made, n.width, n.is_signed);
  }

  /// In the bits in which the operands can differ.
  NodeId comparison(Graph& to, NodeId id, const NewOperands& operands) {
    const Node& n = graph_[id];
    const Facts& a = facts_[n.args[0]];
    const Facts& b = facts_[n.args[1]];
    const int width = a.width();
    const std::uint64_t alike = (a.zeros() & b.zeros()) | (a.ones() & b.ones());
    const int differing = std::max(1, 64 - std::countl_zero(~alike & all_bits(width)));
    const bool keeps_sign = n.op == Op::less && n.is_signed;
    const int by_sign = std::max(a.signed_width(), b.signed_width());
    // Below equal bits numbers are in the order of their patterns.
    const bool as_patterns = differing < width && differing <= by_sign;
    const int bits = as_patterns ? differing : keeps_sign || n.op == Op::equal ? by_sign : width;
    if (bits == width) return no_node;
    const NodeId left = to.slice(operands[0], bits - 1, 0);
    return to.binary(n.op, left, to.slice(operands[1], bits - 1, 0), keeps_sign && !as_patterns);
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
