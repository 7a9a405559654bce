#include "tests/sim/vectors/fault.hpp"

#include <algorithm>
#include <map>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "tests/sim/vectors/fault_kinds.hpp"

namespace hitpipe::sim {
namespace {

using rtl::Graph;
using rtl::Node;
using rtl::NodeId;
using rtl::Op;

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
    if (reader.op == Op::call && fp::operator_of(*graph.submodule_of(id)) == fp::Operator::compare) return;
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
          for (const kinds::Kind& kind : kinds::of_input_bit) add(id, kind, bit);
        break;
      case Op::constant:
        return add(id, kinds::of_constant);
      case Op::slice:
        if (node.low + node.width < graph_[node.args[0]].width) add(id, kinds::a_bit_higher);
        if (node.low > 0) add(id, kinds::a_bit_lower);
        break;
      case Op::concat:
        return add(id, kinds::of_concat);
      case Op::extend:
        return add(id, node.is_signed ? kinds::of_sign_extend : kinds::of_zero_extend);
      case Op::invert:
        return add(id, kinds::of_invert);
      case Op::bit_and:
        return add(id, kinds::of_and);
      case Op::bit_or:
        return add(id, kinds::of_or);
      case Op::bit_xor:
        return add(id, kinds::of_xor);
      case Op::add:
        return add(id, kinds::of_add);
      case Op::sub:
        return add(id, kinds::of_sub);
      case Op::mul:
        add(id, kinds::of_mul);
        if (node.is_signed && can_be_negative(node.args[0])) add(id, kinds::no_first_sign);
        if (node.is_signed && can_be_negative(node.args[1])) add(id, kinds::no_second_sign);
        break;
      case Op::less:
        add(id, kinds::of_less);
        if (choices(graph_, id, node.args[0], node.args[1]).empty()) add(id, kinds::less_or_equal);
        break;
      case Op::equal:
        return add(id, kinds::of_equal);
      case Op::mux:
        return add(id, kinds::of_mux);
      case Op::call:
        return add_all_of_float_unit(id);
    }
  }

  [[nodiscard]] std::vector<Fault> faults() const { return faults_; }

 private:
  void add(NodeId id, const kinds::Kind& kind, int bit = 0) {
    faults_.push_back({id, kind.what, kind.wrong, bit});
  }
  void add(NodeId id, std::span<const kinds::Kind> all) {
    for (const kinds::Kind& kind : all) add(id, kind);
  }

  void add_all_of_float_unit(NodeId id) {
    switch (fp::operator_of(*graph_.submodule_of(id))) {
      case fp::Operator::subtract:
        add(id, kinds::of_fp_subtract);
        if (!only_compared_with_0(id)) add(id, kinds::nearer_to_zero);
        if (zero_sign_is_read(graph_, id)) add(id, kinds::negative_zero);
        break;
      case fp::Operator::multiply:
        add(id, kinds::of_fp_multiply);
        if (zero_sign_is_read(graph_, id)) add(id, kinds::positive_zero);
        break;
      case fp::Operator::subtract_rz:
        return add(id, kinds::of_subtract_rz);
      case fp::Operator::multiply_rz:
        return add(id, kinds::of_multiply_rz);
      case fp::Operator::compare:
        if (bit_is_read(graph_, id, 0)) add(id, kinds::of_fp_less);
        if (bit_is_read(graph_, id, 1)) add(id, kinds::of_fp_greater);
        if (bit_is_read(graph_, id, 0) && equal_operands_matter(id)) {
          add(id, kinds::fp_less_or_equal);
          add(id, kinds::negative_below_positive_zero);
          // Of the constant +0 there is no other sign.
          if (graph_[graph_[id].args[1]].op != Op::constant) add(id, kinds::positive_below_negative_zero);
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

/// The name of the next node that has one.
std::string label_of(const Graph& graph, NodeId id) {
  while (graph[id].name.empty() && !is_output(graph, id)) {
    NodeId reader = id;
    for_each_reader(graph, id, [&](NodeId next) { reader = reader == id ? next : reader; });
    id = reader;
  }
  return graph[id].name;
}

}  // namespace

std::vector<Fault> faults_of(const Graph& graph) {
  FaultList list(graph);
  for (NodeId id = 0; id < graph.size(); ++id) list.add_all_of(id);
  return list.faults();
}

std::vector<std::string> node_names(const Graph& graph) {
  std::vector<std::string> names;
  std::map<std::pair<Op, std::string>, int> counts;
  for (NodeId id = 0; id < graph.size(); ++id) {
    const Node& node = graph[id];
    if (!node.name.empty()) {
      names.push_back(node.name);
      continue;
    }
    const std::string label = label_of(graph, id);
    const int number = ++counts[{node.op, label}];
    names.push_back(label.empty() ? std::to_string(number) : fmt::format("{} of {}", number, label));
  }
  return names;
}

std::string to_text(const Graph& graph, const std::vector<std::string>& names, const Fault& fault) {
  const Node& node = graph[fault.node];
  const std::string op =
      node.op == Op::call ? graph.submodule_of(fault.node)->component : std::string(op_name(node.op));
  const std::string bit =
      node.op == Op::input && node.width > 1 ? fmt::format(" bit {}", fault.bit) : std::string();
  return fmt::format("{} {}{}: {}", op, names.at(fault.node), bit, fault.what);
}

}  // namespace hitpipe::sim
