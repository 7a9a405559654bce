#include <algorithm>
#include <bit>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "rtl_gen/prune/analysis.hpp"
#include "rtl_gen/prune/passes.hpp"
#include "rtl_gen/prune/report.hpp"
#include "rtl_gen/prune/rewrite.hpp"

namespace hitpipe::rtl {

namespace {

/// What is known of an operand, as a demand on the port of the unit that reads it. Known bits in the middle
/// of a pattern are lost.
PortDemand demand_of(const std::string& port, const Facts& facts) {
  const int width = facts.width();
  const std::uint64_t top = std::uint64_t{1} << (width - 1);
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

std::uint64_t known_bits(const Facts& facts) {
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
    const std::shared_ptr<const Unit>& unit = graph_.unit_of(id);
    Demands demands;
    int changing = 0;  // bits of the operand that has most of those
    for (std::size_t i = 0; i < n.operands().size(); ++i) {
      const Facts& facts = facts_[n.args[i]];
      changing = std::max(changing, facts.width() - std::popcount(known_bits(facts)));
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

  static const Node& port(const Unit& unit, std::size_t i) { return unit.body[unit.body.inputs()[i]]; }

  /// Units that are cut in the same way become one. Their numbers follow the order of the calls.
  std::shared_ptr<const Unit> named(const Unit& cut) {
    const std::string& name = cut.body.name();
    const std::string whole = name.substr(0, name.find(cut_mark));
    std::vector<Known>& known = cuts_[whole];
    const std::string text = to_text(renamed(cut.body, whole));
    for (const Known& each : known)
      if (each.text == text && each.unit->bits == cut.bits) return each.unit;
    known.push_back(
        {text, std::make_shared<const Unit>(
                   Unit{cut.component, cut.bits,
                        renamed(cut.body, fmt::format("{}{}{}", whole, cut_mark, known.size() + 1))})});
    return known.back().unit;
  }

  struct Known {
    std::string text;  ///< of the body, with the name of the whole unit
    std::shared_ptr<const Unit> unit;
  };

  const Graph& graph_;
  std::vector<Facts> facts_;
  std::map<std::string, std::vector<Known>> cuts_;
};

}  // namespace

Graph narrow_units(const Graph& graph, const Demands& demands) {
  return NarrowUnits(graph, demands).made();
}

}  // namespace hitpipe::rtl
