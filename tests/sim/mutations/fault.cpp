#include "tests/sim/mutations/fault.hpp"

#include <algorithm>
#include <span>

#include <fmt/format.h>

#include "tests/sim/mutations/float_units.hpp"

namespace hitpipe::sim {
namespace {

using rtl::Graph;
using rtl::Node;
using rtl::NodeId;
using rtl::Op;

struct Kind {
  const char* what;
  std::uint64_t (*wrong)(const Site& site);
};

std::uint64_t as_unsigned(std::int64_t value) {
  return static_cast<std::uint64_t>(value);
}

bool less(std::uint64_t a, std::uint64_t b, int width, bool is_signed) {
  return is_signed ? rtl::two_s_complement(a, width) < rtl::two_s_complement(b, width) : a < b;
}
bool less(const Site& s) {
  return less(s.a, s.b, s.width_a, s.node.is_signed);
}
bool greater(const Site& s) {
  return less(s.b, s.a, s.width_a, s.node.is_signed);
}

std::uint64_t no(const Site& /*site*/) {
  return 0;
}
std::uint64_t yes(const Site& /*site*/) {
  return 1;
}
std::uint64_t one_more(const Site& s) {
  return s.right + 1;
}
std::uint64_t one_less(const Site& s) {
  return s.right - 1;
}
std::uint64_t first_operand(const Site& s) {
  return s.a;
}
std::uint64_t second_operand(const Site& s) {
  return s.b;
}

/// Of two factors, each read as the product of them does.
std::uint64_t product(std::int64_t a, std::int64_t b) {
  return as_unsigned(a) * as_unsigned(b);
}
std::int64_t factor(std::uint64_t value, int width, bool is_signed) {
  return is_signed ? rtl::two_s_complement(value, width) : static_cast<std::int64_t>(value);
}
std::int64_t factor_a(const Site& s) {
  return factor(s.a, s.width_a, s.node.is_signed);
}
std::int64_t factor_b(const Site& s) {
  return factor(s.b, s.width_b, s.node.is_signed);
}

const Kind of_less[] = {
    {"as >", [](const Site& s) -> std::uint64_t { return greater(s); }},
    {"as >=", [](const Site& s) -> std::uint64_t { return !less(s); }},
    {"with the other sign",
     [](const Site& s) -> std::uint64_t { return less(s.a, s.b, s.width_a, !s.node.is_signed); }},
    {"always 0", no},
    {"always 1", yes},
};
const Kind less_or_equal{"as <=", [](const Site& s) -> std::uint64_t { return !greater(s); }};

const Kind of_equal[] = {
    {"as !=", [](const Site& s) -> std::uint64_t { return s.a != s.b; }},
    {"always 0", no},
    {"always 1", yes},
};
const Kind of_mux[] = {
    {"with its arms exchanged", [](const Site& s) { return s.a != 0 ? s.c : s.b; }},
    {"stuck at its first arm", second_operand},
    {"stuck at its second arm", [](const Site& s) { return s.c; }},
};
const Kind of_add[] = {
    {"as -", [](const Site& s) { return s.a - s.b; }},
    {"one too large", one_more},
    {"one too small", one_less},
};
const Kind of_sub[] = {
    {"with its operands exchanged", [](const Site& s) { return s.b - s.a; }},
    {"as +", [](const Site& s) { return s.a + s.b; }},
    {"one too large", one_more},
    {"one too small", one_less},
};
const Kind of_mul[] = {
    {"without the lowest bit of its first operand",
     [](const Site& s) { return product(factor_a(s) & ~std::int64_t{1}, factor_b(s)); }},
    {"without the lowest bit of its second operand",
     [](const Site& s) { return product(factor_a(s), factor_b(s) & ~std::int64_t{1}); }},
    {"without the highest bit of its first operand",
     [](const Site& s) {
       return product(factor(s.a << (65 - s.width_a) >> (65 - s.width_a), s.width_a - 1, s.node.is_signed),
                      factor_b(s));
     }},
    {"without the highest bit of its second operand",
     [](const Site& s) {
       return product(factor_a(s),
                      factor(s.b << (65 - s.width_b) >> (65 - s.width_b), s.width_b - 1, s.node.is_signed));
     }},
};
const Kind no_first_sign{"without the sign of its first operand",
                         [](const Site& s) { return product(static_cast<std::int64_t>(s.a), factor_b(s)); }};
const Kind no_second_sign{"without the sign of its second operand",
                          [](const Site& s) { return product(factor_a(s), static_cast<std::int64_t>(s.b)); }};
const Kind of_input_bit[] = {
    {"always 0", [](const Site& s) { return s.right & ~(std::uint64_t{1} << s.bit); }},
    {"always 1", [](const Site& s) { return s.right | std::uint64_t{1} << s.bit; }},
};
const Kind of_sign_extend{"by zeros", first_operand};
const Kind of_zero_extend{"by the sign",
                          [](const Site& s) { return as_unsigned(rtl::two_s_complement(s.a, s.width_a)); }};
const Kind of_constant[] = {{"one too large", one_more}, {"one too small", one_less}};
const Kind a_bit_higher{"a bit higher", [](const Site& s) { return s.a >> (s.node.low + 1); }};
const Kind a_bit_lower{"a bit lower", [](const Site& s) { return s.a >> (s.node.low - 1); }};
const Kind of_concat{"with its parts exchanged", [](const Site& s) { return s.b << s.width_a | s.a; }};
const Kind of_and[] = {{"as |", [](const Site& s) { return s.a | s.b; }},
                       {"without its second operand", first_operand},
                       {"without its first operand", second_operand}};
const Kind of_or[] = {{"as &", [](const Site& s) { return s.a & s.b; }},
                      {"without its second operand", first_operand},
                      {"without its first operand", second_operand}};
const Kind of_xor[] = {{"as |", [](const Site& s) { return s.a | s.b; }},
                       {"without its second operand", first_operand},
                       {"without its first operand", second_operand}};
const Kind of_invert{"dropped", first_operand};

const Kind of_fp_subtract[] = {
    {"with its operands exchanged", [](const Site& s) { return fp::subtract(s.b, s.a); }},
    {"as +", [](const Site& s) { return fp::subtract(s.a, fp::negated(s.b)); }},
    {"with the other sign", [](const Site& s) { return fp::negated(s.right); }},
    {"an ulp farther from 0", [](const Site& s) { return fp::farther_from_0(s.right); }},
    {"with 0 for NaN", [](const Site& s) { return fp::is_nan(s.right) ? 0 : s.right; }},
    {"with infinity for NaN", [](const Site& s) { return fp::is_nan(s.right) ? fp::infinity : s.right; }},
};
const Kind nearer_to_zero{"an ulp nearer to 0", [](const Site& s) { return fp::nearer_to_0(s.right); }};
const Kind negative_zero{"with -0 for +0",
                         [](const Site& s) { return s.right == 0 ? fp::negated(0) : s.right; }};
const Kind positive_zero{"with +0 for -0",
                         [](const Site& s) { return s.right == fp::negated(0) ? 0 : s.right; }};
const Kind of_fp_multiply[] = {
    {"without the sign of its first operand",
     [](const Site& s) { return fp::multiply(fp::magnitude(s.a), s.b); }},
    {"without the sign of its second operand",
     [](const Site& s) { return fp::multiply(s.a, fp::magnitude(s.b)); }},
    {"with the other sign", [](const Site& s) { return fp::negated(s.right); }},
    {"an ulp farther from 0", [](const Site& s) { return fp::farther_from_0(s.right); }},
    {"an ulp nearer to 0", [](const Site& s) { return fp::nearer_to_0(s.right); }},
    {"with 0 for NaN", [](const Site& s) { return fp::is_nan(s.right) ? 0 : s.right; }},
    {"with infinity for NaN", [](const Site& s) { return fp::is_nan(s.right) ? fp::infinity : s.right; }},
    {"with 0 for infinity",
     [](const Site& s) { return fp::magnitude(s.right) == fp::infinity ? 0 : s.right; }},
};
std::uint64_t ones(int width) {
  return ~std::uint64_t{0} >> (64 - width);
}
const Kind of_subtract_rz[] = {
    {"with the other sign", [](const Site& s) { return s.right ^ std::uint64_t{1} << (s.node.width - 1); }},
    {"an ulp farther from 0",
     [](const Site& s) {
       return (s.right & ones(s.node.width - 1)) < ones(s.node.width - 1) ? s.right + 1 : s.right;
     }},
    {"an ulp nearer to 0",
     [](const Site& s) { return (s.right & ones(s.node.width - 1)) != 0 ? s.right - 1 : s.right; }},
};
const Kind of_multiply_rz[] = {
    {"an ulp larger", [](const Site& s) { return s.right < ones(s.node.width) ? s.right + 1 : s.right; }},
    {"an ulp smaller", [](const Site& s) { return s.right != 0 ? s.right - 1 : s.right; }},
    {"with 0 for the most", [](const Site& s) { return s.right == ones(s.node.width) ? 0 : s.right; }},
};
/// Of the order that is read, less or greater.
const Kind of_fp_less[] = {
    {"less: as >", [](const Site& s) { return fp::swapped(s.right); }},
    {"less: true of NaN", [](const Site& s) { return s.right | (fp::unordered(s.a, s.b) ? 1U : 0U); }},
    {"less: of magnitudes",
     [](const Site& s) { return fp::compare(fp::magnitude(s.a), fp::magnitude(s.b)); }},
    {"less: of patterns", [](const Site& s) { return s.a < s.b ? 1U : std::uint64_t{0}; }},
    {"less: always 0", [](const Site& s) { return s.right & ~std::uint64_t{1}; }},
    {"less: always 1", [](const Site& s) { return s.right | 1U; }},
};
/// These matter where equal operands do.
const Kind fp_less_or_equal{"less: as <=",
                            [](const Site& s) { return s.right | (fp::are_equal(s.a, s.b) ? 1U : 0U); }};
const Kind negative_below_positive_zero{"less: -0 below +0", [](const Site& s) {
                                          return s.right | (s.a == fp::negated(0) && s.b == 0 ? 1U : 0U);
                                        }};
const Kind positive_below_negative_zero{"less: +0 below -0", [](const Site& s) {
                                          return s.right | (s.b == fp::negated(0) && s.a == 0 ? 1U : 0U);
                                        }};
const Kind of_fp_greater[] = {
    {"greater: as <", [](const Site& s) { return fp::swapped(s.right); }},
    {"greater: as >=", [](const Site& s) { return s.right | (fp::are_equal(s.a, s.b) ? 2U : 0U); }},
    {"greater: true of NaN", [](const Site& s) { return s.right | (fp::unordered(s.a, s.b) ? 2U : 0U); }},
    {"greater: of magnitudes",
     [](const Site& s) { return fp::compare(fp::magnitude(s.a), fp::magnitude(s.b)); }},
    {"greater: of patterns", [](const Site& s) { return s.a > s.b ? 2U : std::uint64_t{0}; }},
    {"greater: always 0", [](const Site& s) { return s.right & ~std::uint64_t{2}; }},
    {"greater: always 1", [](const Site& s) { return s.right | 2U; }},
};

template <class Visit>
void for_each_reader(const Graph& graph, NodeId of, Visit&& visit) {
  for (NodeId id = of + 1; id < graph.size(); ++id) {
    const auto operands = graph[id].operands();
    if (std::find(operands.begin(), operands.end(), of) != operands.end()) visit(id);
  }
}

bool is_output(const Graph& graph, NodeId node) {
  return std::any_of(graph.outputs().begin(), graph.outputs().end(),
                     [&](const rtl::Output& out) { return out.node == node; });
}

/// The multiplexers that read `bit`, when all its readers are multiplexers that choose between a and b.
std::vector<NodeId> choices(const Graph& graph, NodeId bit, NodeId a, NodeId b) {
  std::vector<NodeId> muxes;
  bool all = !is_output(graph, bit);
  for_each_reader(graph, bit, [&](NodeId id) {
    const auto& [select, first, second] = graph[id].args;
    const bool chooses = graph[id].op == Op::mux && select == bit &&
                         ((first == a && second == b) || (first == b && second == a));
    all = all && chooses;
    muxes.push_back(id);
  });
  return all ? muxes : std::vector<NodeId>{};
}

/// Whether -0 in place of +0 can change an output. Float operators take one for the other, and give numbers
/// that differ in the sign of a zero at most.
bool zero_sign_is_read(const Graph& graph, NodeId node) {
  bool is_read = is_output(graph, node);
  for_each_reader(graph, node, [&](NodeId id) {
    const Node& reader = graph[id];
    if (reader.op == Op::call && fp::operator_of(*graph.unit_of(id)) == fp::Operator::compare) return;
    const bool passes_it_on = reader.op == Op::call || (reader.op == Op::mux && reader.args[0] != node);
    is_read = is_read || !passes_it_on || zero_sign_is_read(graph, id);
  });
  return is_read;
}

bool bit_is_read(const Graph& graph, NodeId node, int bit) {
  for (NodeId id = node + 1; id < graph.size(); ++id)
    if (graph[id].op == Op::slice && graph[id].args[0] == node && graph[id].low == bit) return true;
  return false;
}

class FaultList {
 public:
  explicit FaultList(const Graph& graph) : graph_(graph) {}

  void add_all_of(NodeId id) {
    const Node& node = graph_[id];
    switch (node.op) {
      case Op::input:
        for (int bit = 0; bit < node.width; ++bit)
          for (const Kind& kind : of_input_bit) add(id, kind, bit);
        break;
      case Op::constant:
        return add(id, of_constant);
      case Op::slice:
        if (node.low + node.width < graph_[node.args[0]].width) add(id, a_bit_higher);
        if (node.low > 0) add(id, a_bit_lower);
        break;
      case Op::concat:
        return add(id, of_concat);
      case Op::extend:
        return add(id, node.is_signed ? of_sign_extend : of_zero_extend);
      case Op::invert:
        return add(id, of_invert);
      case Op::bit_and:
        return add(id, of_and);
      case Op::bit_or:
        return add(id, of_or);
      case Op::bit_xor:
        return add(id, of_xor);
      case Op::add:
        return add(id, of_add);
      case Op::sub:
        return add(id, of_sub);
      case Op::mul:
        add(id, of_mul);
        if (node.is_signed && can_be_negative(node.args[0])) add(id, no_first_sign);
        if (node.is_signed && can_be_negative(node.args[1])) add(id, no_second_sign);
        break;
      case Op::less:
        add(id, of_less);
        if (choices(graph_, id, node.args[0], node.args[1]).empty()) add(id, less_or_equal);
        break;
      case Op::equal:
        return add(id, of_equal);
      case Op::mux:
        return add(id, of_mux);
      case Op::call:
        return add_all_of_float_unit(id);
    }
  }

  [[nodiscard]] std::vector<Fault> faults() const { return faults_; }

 private:
  void add(NodeId id, const Kind& kind, int bit = 0) { faults_.push_back({id, kind.what, kind.wrong, bit}); }
  void add(NodeId id, std::span<const Kind> kinds) {
    for (const Kind& kind : kinds) add(id, kind);
  }

  void add_all_of_float_unit(NodeId id) {
    switch (fp::operator_of(*graph_.unit_of(id))) {
      case fp::Operator::subtract:
        add(id, of_fp_subtract);
        if (!only_compared_with_0(id)) add(id, nearer_to_zero);
        if (zero_sign_is_read(graph_, id)) add(id, negative_zero);
        break;
      case fp::Operator::multiply:
        add(id, of_fp_multiply);
        if (zero_sign_is_read(graph_, id)) add(id, positive_zero);
        break;
      case fp::Operator::subtract_rz:
        return add(id, of_subtract_rz);
      case fp::Operator::multiply_rz:
        return add(id, of_multiply_rz);
      case fp::Operator::compare:
        if (bit_is_read(graph_, id, 0)) add(id, of_fp_less);
        if (bit_is_read(graph_, id, 1)) add(id, of_fp_greater);
        if (bit_is_read(graph_, id, 0) && equal_operands_matter(id)) {
          add(id, fp_less_or_equal);
          add(id, negative_below_positive_zero);
          // Of the constant +0 there is no other sign.
          if (graph_[graph_[id].args[1]].op != Op::constant) add(id, positive_below_negative_zero);
        }
    }
  }
  /// Then an ulp matters for the smallest subnormal alone.
  [[nodiscard]] bool only_compared_with_0(NodeId id) const {
    bool only = true;
    for_each_reader(graph_, id, [&](NodeId reader) {
      const Node& node = graph_[reader];
      only = only && node.op == Op::call && graph_[node.args[1]].op == Op::constant;
    });
    return only;
  }
  /// Not where a float comparator chooses one of its operands, and the sign of a zero is not read.
  [[nodiscard]] bool equal_operands_matter(NodeId comparator) const {
    bool matter = false;
    for_each_reader(graph_, comparator, [&](NodeId bit) {
      const std::vector<NodeId> muxes =
          choices(graph_, bit, graph_[comparator].args[0], graph_[comparator].args[1]);
      matter = matter || muxes.empty() || std::any_of(muxes.begin(), muxes.end(), [&](NodeId mux) {
                 return zero_sign_is_read(graph_, mux);
               });
    });
    return matter;
  }

  /// As a factor: a word widened by zeros cannot.
  [[nodiscard]] bool can_be_negative(NodeId id) const {
    return graph_[id].op != Op::extend || graph_[id].is_signed;
  }

  const Graph& graph_;
  std::vector<Fault> faults_;
};

/// The name of the node, or "%7 of near", with the name of a node that it leads to.
std::string name_of(const Graph& graph, NodeId id) {
  if (!graph[id].name.empty()) return graph[id].name;
  std::string name = fmt::format("%{}", id);
  NodeId reader = id;
  while (graph[reader].name.empty() && !is_output(graph, reader)) {
    const NodeId from = reader;
    for_each_reader(graph, from, [&](NodeId next) { reader = reader == from ? next : reader; });
  }
  return graph[reader].name.empty() ? name : fmt::format("{} of {}", name, graph[reader].name);
}

}  // namespace

std::vector<Fault> faults_of(const Graph& graph) {
  FaultList list(graph);
  for (NodeId id = 0; id < graph.size(); ++id) list.add_all_of(id);
  return list.faults();
}

std::string to_text(const Graph& graph, const Fault& fault) {
  const Node& node = graph[fault.node];
  const std::string op =
      node.op == Op::call ? graph.unit_of(fault.node)->component : std::string(op_name(node.op));
  const std::string bit =
      node.op == Op::input && node.width > 1 ? fmt::format(" bit {}", fault.bit) : std::string();
  return fmt::format("{} {}{}: {}", op, name_of(graph, fault.node), bit, fault.what);
}

}  // namespace hitpipe::sim
