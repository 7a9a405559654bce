// The passes that compute values in fewer bits: of nodes, inside float operators, and at the ports.
#include <algorithm>
#include <bit>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "rtl_gen/graph/rewrite.hpp"
#include "rtl_gen/prune/facts.hpp"
#include "rtl_gen/prune/prune.hpp"
#include "rtl_gen/prune/report.hpp"

namespace hitpipe::rtl {

namespace {

/// The bits of a value that must be computed. All lower bits are known. All higher bits are known too, or
/// with `by_sign` they repeat the highest computed bit.
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
  const Word above = facts.ones() >> core.width;
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
      const int bits = std::max(1, n.is_signed ? f.signed_width() : width_of_bits(f.patterns().high));
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
    const Word alike = (a.zeros() & b.zeros()) | (a.ones() & b.ones());
    const int differing = std::max(1, width_of_bits(~alike & ones_below(width)));
    const bool keeps_sign = n.op == Op::less && n.is_signed;
    const int by_sign = std::max(a.signed_width(), b.signed_width());
    // When the high bits are equal, the unsigned patterns below them decide.
    const bool as_patterns = differing < width && differing <= by_sign;
    const int bits = as_patterns ? differing : keeps_sign || n.op == Op::equal ? by_sign : width;
    const int low = std::min(low_ones(alike), bits - 1);
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

namespace {

/// What is known of an operand, as a demand on the port of the unit that reads it. Known bits in the middle
/// of a pattern are lost.
PortDemand demand_of(const std::string& port, const Facts& facts) {
  const int width = facts.width();
  const Word top = Word{1} << (width - 1);
  PortDemand demand{port, {}};
  const auto add = [&](const Facts& half) {
    const Patterns patterns = half.patterns();
    demand.within.push_back(
        {static_cast<std::int64_t>(patterns.low), static_cast<std::int64_t>(patterns.high)});
  };
  if ((facts.ones() & top) == 0) add(Facts::both(facts, Facts::bits(width, top, 0)));
  if ((facts.zeros() & top) == 0) add(Facts::both(facts, Facts::bits(width, 0, top)));
  if (!facts.is_constant()) demand.low_zeros = facts.low_zeros();
  return demand;
}

Word known_bits(const Facts& facts) {
  return facts.zeros() | facts.ones();
}

bool has(const Graph& body, bool (*wanted)(Op)) {
  for (NodeId id = 0; id < body.size(); ++id)
    if (wanted(body[id].op)) return true;
  return false;
}

/// Records the body's nodes in another graph, and returns its result.
NodeId copied(Graph& to, const Graph& body, const NewOperands& operands) {
  std::vector<NodeId> made(body.size(), no_node);
  for (std::size_t i = 0; i < body.inputs().size(); ++i) made[body.inputs()[i]] = operands[i];
  for (NodeId id = 0; id < body.size(); ++id) {
    if (made[id] != no_node) continue;
    NewOperands args{no_node, no_node, no_node};
    for (std::size_t i = 0; i < body[id].operands().size(); ++i) args[i] = made[body[id].args[i]];
    made[id] = record_again(to, body, id, args);
    to.annotate(made[id], body[id].name, body[id].source);
  }
  return made[body.outputs().front().node];
}

Graph renamed(const Graph& body, const std::string& name) {
  Graph to(name);
  NewOperands ports{no_node, no_node, no_node};
  for (std::size_t i = 0; i < body.inputs().size(); ++i) {
    const Node& port = body[body.inputs()[i]];
    ports[i] = to.input(port.name, port.width, port.is_signed);
  }
  to.output(body.outputs().front().name, copied(to, body, ports));
  return to;
}

constexpr const char* cut_mark = "_cut";

class NarrowUnits {
 public:
  NarrowUnits(const Graph& graph, const Demands& demands) : graph_(graph), facts_(analyse(graph, demands)) {}

  [[nodiscard]] Graph made() {
    return rewrite(graph_, [this](Graph& to, NodeId id, const NewOperands& operands) {
      return graph_[id].op == Op::call ? call(to, id, operands) : no_node;
    });
  }

 private:
  NodeId call(Graph& to, NodeId id, const NewOperands& operands) {
    const Node& n = graph_[id];
    const std::shared_ptr<const Submodule>& unit = graph_.submodule_of(id);
    Demands demands;
    int changing = 0;  // bits of the operand that has most of those
    for (std::size_t i = 0; i < n.operands().size(); ++i) {
      const Facts& facts = facts_[n.args[i]];
      changing = std::max(changing, facts.width() - count_of_ones(known_bits(facts)));
      if (known_bits(facts) != 0) demands.ports.push_back(demand_of(port(*unit, i).name, facts));
    }
    const std::vector<NodeId> arguments(operands.begin(), operands.begin() + n.arity());
    const bool was_cut = unit->body.name().find(cut_mark) != std::string::npos;
    const Graph body = demands.empty() ? unit->body : simplified(unit->body, demands);
    if (!has(body, [](Op op) { return is_root(op) && op != Op::input; })) return copied(to, body, operands);
    // What can be simplified without knowing the operands is no cut.
    const bool is_cut = !demands.empty() && size_of(body) != size_of(simplified(unit->body, {}));
    if (!was_cut && !is_cut) return to.call(unit, arguments);
    // Fewer bits of operands make a sum or an order smaller, but not a product of significands.
    const bool of_operands = !has(body, [](Op op) { return op == Op::mul; }) && changing > 0;
    return to.call(named({unit->component, of_operands ? std::min(unit->bits, changing) : unit->bits,
                          is_cut ? body : unit->body}),
                   arguments);
  }

  static const Node& port(const Submodule& unit, std::size_t i) { return unit.body[unit.body.inputs()[i]]; }

  /// Units that are cut in the same way become one. Their numbers follow the order of the calls.
  std::shared_ptr<const Submodule> named(const Submodule& cut) {
    const std::string& name = cut.body.name();
    const std::string whole = name.substr(0, name.find(cut_mark));
    std::vector<Known>& known = cuts_[whole];
    const std::string text = to_text(renamed(cut.body, whole));
    for (const Known& each : known)
      if (each.text == text && each.unit->bits == cut.bits) return each.unit;
    known.push_back(
        {text, std::make_shared<const Submodule>(
                   Submodule{cut.component, cut.bits,
                             renamed(cut.body, fmt::format("{}{}{}", whole, cut_mark, known.size() + 1))})});
    return known.back().unit;
  }

  struct Known {
    std::string text;  ///< of the body, with the name of the whole unit
    std::shared_ptr<const Submodule> unit;
  };

  const Graph& graph_;
  std::vector<Facts> facts_;
  std::map<std::string, std::vector<Known>> cuts_;
};

}  // namespace

Graph narrow_units(const Graph& graph, const Demands& demands) {
  return NarrowUnits(graph, demands).made();
}

Graph narrow_ports(const Graph& graph, const Demands& demands) {
  const std::vector<Facts> facts = analyse(graph, demands);
  const std::vector<Word> read = read_bits(graph);
  const auto port = [&](Graph& to, NodeId id) {
    const Node& n = graph[id];
    const int width = width_of_bits(read[id]);
    if (width == 0) return to.constant(n.width, 0);  // its readers are not read either
    const bool is_signed = n.is_signed && width >= facts[id].signed_width();
    return to.extend(to.input(n.name, width, is_signed), n.width, is_signed);
  };
  return rewrite(graph, port, [](Graph&, NodeId, const NewOperands&) { return no_node; });
}

}  // namespace hitpipe::rtl
