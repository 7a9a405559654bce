#include "rtl_gen/graph/graph.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

#include <fmt/format.h>

#include "rtl_gen/graph/operation.hpp"

namespace hitpipe::rtl {

namespace {

bool are_equal(const Submodule& a, const Submodule& b) {
  return a.component == b.component && a.bits == b.bits && to_text(a.body) == to_text(b.body);
}

}  // namespace

std::string_view op_name(Op op) {
  constexpr std::array<std::string_view, 16> names{"input", "const", "slice", "concat", "extend", "not",
                                                   "and",   "or",    "xor",   "add",    "sub",    "mul",
                                                   "cmp",   "eq",    "mux",   "call"};
  return names.at(static_cast<std::size_t>(op));
}

NodeId Graph::record(Node node) {
  if (node.width < 1 || node.width > most_value_bits) {
    throw std::invalid_argument(
        fmt::format("graph {}: a value of {} bits, allowed are 1 to {}", name_, node.width, most_value_bits));
  }
  widest_ = std::max(widest_, node.width);
  node.min_stage = is_root(node.op) && node.op != Op::input ? min_stage_ : 0;
  const Key key{node.op,        node.width, node.is_signed, node.low,
                node.submodule, node.value, node.args,      node.min_stage};
  if (node.op != Op::input)
    if (const auto found = known_.find(key); found != known_.end()) return found->second;
  const auto id = static_cast<NodeId>(nodes_.size());
  if (node.op != Op::input) known_.emplace(key, id);
  nodes_.push_back(std::move(node));
  return id;
}

NodeId Graph::input(std::string_view name, int width, bool is_signed) {
  Node n{.op = Op::input, .width = width, .is_signed = is_signed};
  n.name = name;
  const NodeId id = record(std::move(n));
  inputs_.push_back(id);
  return id;
}

NodeId Graph::constant(int width, Word value) {
  return record({.op = Op::constant,
                 .width = width,
                 .value = value & ones_below(std::clamp(width, 0, most_value_bits))});
}

// A reference to a node is good until a node is recorded.

NodeId Graph::slice(NodeId a, int high, int low) {
  const Node& n = nodes_[a];
  const int width = high - low + 1;
  if (low < 0 || width < 1 || high >= n.width) {
    throw std::invalid_argument(
        fmt::format("graph {}: bits {}:{} of a {}-bit value", name_, high, low, n.width));
  }
  if (width == n.width) return a;
  switch (n.op) {  // a slice is moved through wires, to a value that can be latched
    case Op::constant:
      return constant(width, n.value >> low);
    case Op::slice:
      return slice(n.args[0], n.low + high, n.low + low);
    case Op::invert:
      return invert(slice(n.args[0], high, low));
    case Op::concat: {
      const NodeId upper = n.args[0];
      const NodeId lower = n.args[1];
      const int split = nodes_[lower].width;
      if (high < split) return slice(lower, high, low);
      if (low >= split) return slice(upper, high - split, low - split);
      const NodeId end = slice(lower, split - 1, low);
      return concat(slice(upper, high - split, 0), end);
    }
    case Op::extend: {
      const bool is_signed = n.is_signed;
      const int source = nodes_[n.args[0]].width;
      if (high < source) return slice(n.args[0], high, low);
      if (low < source) return extend(slice(n.args[0], source - 1, low), width, is_signed);
      if (!is_signed) return constant(width, 0);
      return extend(slice(n.args[0], source - 1, source - 1), width, true);
    }
    default:
      return record({.op = Op::slice, .width = width, .low = low, .args = {a, no_node, no_node}});
  }
}

NodeId Graph::concat(NodeId high, NodeId low) {
  const Node& h = nodes_[high];
  const Node& l = nodes_[low];
  if (h.op == Op::slice && l.op == Op::slice && h.args[0] == l.args[0] && h.low == l.low + l.width)
    return slice(h.args[0], h.low + h.width - 1, l.low);
  return record({.op = Op::concat, .width = h.width + l.width, .args = {high, low, no_node}});
}

NodeId Graph::extend(NodeId a, int width, bool is_signed) {
  const Node& n = nodes_[a];
  if (width == n.width) return a;
  if (n.op == Op::constant)
    return constant(width, is_signed ? static_cast<Word>(number_of(n.value, n.width)) : n.value);
  if (n.op == Op::extend && (n.is_signed == is_signed || !n.is_signed)) {
    return extend(n.args[0], width, n.is_signed);
  }
  return record({.op = Op::extend, .width = width, .is_signed = is_signed, .args = {a, no_node, no_node}});
}

NodeId Graph::resize(NodeId a, int width, bool is_signed) {
  return width <= nodes_[a].width ? slice(a, width - 1, 0) : extend(a, width, is_signed);
}

NodeId Graph::invert(NodeId a) {
  const Node& n = nodes_[a];
  if (n.op == Op::invert) return n.args[0];
  if (n.op == Op::constant) return constant(n.width, ~n.value);
  return record({.op = Op::invert, .width = n.width, .args = {a, no_node, no_node}});
}

NodeId Graph::binary(Op op, NodeId a, NodeId b, bool is_signed) {
  const int wa = nodes_[a].width;
  const int wb = nodes_[b].width;
  if (op != Op::mul && wa != wb) {
    throw std::invalid_argument(
        fmt::format("graph {}: {} of {} and {} bits, the widths must be equal", name_, op_name(op), wa, wb));
  }
  const int width = op == Op::mul ? wa + wb : op == Op::less || op == Op::equal ? 1 : wa;
  return record({.op = op, .width = width, .is_signed = is_signed, .args = {a, b, no_node}});
}

NodeId Graph::mux(NodeId select, NodeId if_one, NodeId if_zero) {
  if (nodes_[select].width != 1 || nodes_[if_one].width != nodes_[if_zero].width) {
    throw std::invalid_argument(fmt::format("graph {}: mux of {} and {} bits by {} bits", name_,
                                            nodes_[if_one].width, nodes_[if_zero].width,
                                            nodes_[select].width));
  }
  if (if_one == if_zero) return if_one;
  return record({.op = Op::mux, .width = nodes_[if_one].width, .args = {select, if_one, if_zero}});
}

NodeId Graph::call(const std::shared_ptr<const Submodule>& unit, std::span<const NodeId> operands) {
  const Graph& body = unit->body;
  if (body.outputs().size() != 1 || operands.size() != body.inputs().size() || operands.empty() ||
      operands.size() > 3) {
    throw std::invalid_argument(fmt::format(
        "graph {}: {} takes {} operands and gives {} results, a call has 1 to 3 and 1; here are {}", name_,
        body.name(), body.inputs().size(), body.outputs().size(), operands.size()));
  }
  const NodeId result = body.outputs().front().node;
  Node n{.op = Op::call, .width = body[result].width};
  for (std::size_t i = 0; i < operands.size(); ++i) {
    const int wanted = body[body.inputs()[i]].width;
    if (nodes_[operands[i]].width != wanted) {
      throw std::invalid_argument(fmt::format("graph {}: operand {} of {} has {} bits, not {}", name_, i,
                                              body.name(), nodes_[operands[i]].width, wanted));
    }
    n.args[i] = operands[i];
  }
  const auto same = [&](const auto& known) { return known->body.name() == body.name(); };
  const auto found = std::find_if(submodules_.begin(), submodules_.end(), same);
  n.submodule = static_cast<int>(found - submodules_.begin());
  if (found == submodules_.end()) {
    submodules_.push_back(unit);
  } else if (*found != unit && !are_equal(**found, *unit)) {
    throw std::invalid_argument(
        fmt::format("graph {}: two different units have the name {}", name_, body.name()));
  }
  return record(std::move(n));
}

void Graph::output(std::string_view name, NodeId node) {
  outputs_.push_back({std::string(name), node});
}

void Graph::annotate(NodeId node, std::string_view name, const SourceLine& source) {
  Node& n = nodes_[node];
  if (!n.name.empty() || name.empty()) return;
  n.name = name;
  n.source = source;
  NamedPart part{n.width - 1, 0, n.name, source};
  NodeId at = node;
  for (; nodes_[at].op == Op::slice || nodes_[at].op == Op::extend; at = nodes_[at].args[0]) {
    const Node& wire = nodes_[at];
    part.high = std::min(part.high + wire.low, nodes_[wire.args[0]].width - 1);
    part.low += wire.low;
  }
  if (at != node) add_part(at, part);
}

void Graph::add_part(NodeId node, const NamedPart& part) {
  Node& n = nodes_[node];
  if (!is_root(n.op) || n.op == Op::input) return;
  const NamedPart added{std::min(part.high, n.width - 1), part.low, part.name, part.source};
  const auto same = [&](const NamedPart& known) {
    return known.high == added.high && known.low == added.low && known.name == added.name;
  };
  if (added.high >= added.low && std::none_of(n.parts.begin(), n.parts.end(), same)) n.parts.push_back(added);
}

void Graph::annotate_as(NodeId node, const Node& other) {
  annotate(node, other.name, other.source);
  if (nodes_[node].op != other.op) return;
  for (const NamedPart& part : other.parts) add_part(node, part);
}

std::string to_text(const Graph& graph) {
  std::string text = fmt::format("graph {}\n", graph.name());
  for (NodeId id = 0; id < graph.size(); ++id) {
    const Node& n = graph[id];
    text += fmt::format("%{} = {}:{}", id, op_name(n.op), n.width);
    if (n.is_signed) text += " signed";
    for (const NodeId arg : n.operands()) text += fmt::format(" %{}", arg);
    if (n.op == Op::slice) text += fmt::format(" [{}:{}]", n.low + n.width - 1, n.low);
    if (n.op == Op::constant) text += fmt::format(" {:#x}", n.value);
    if (n.op == Op::call) text += fmt::format(" {}", graph.submodule_of(id)->body.name());
    if (n.min_stage > 0) text += fmt::format(" stage>={}", n.min_stage);
    if (!n.name.empty()) text += fmt::format("  {}", n.name);
    if (n.source.line != 0) text += fmt::format(" @ {}:{}", n.source.file, n.source.line);
    text += '\n';
  }
  for (const Output& out : graph.outputs()) text += fmt::format("output {} %{}\n", out.name, out.node);
  for (const auto& unit : graph.submodules()) text += to_text(unit->body);
  return text;
}

namespace {

/// Each node's value, in words that hold each.
template <class W>
std::vector<W> values_in(const Graph& graph, std::span<const std::uint64_t> inputs) {
  std::vector<W> value(graph.size());
  std::size_t next_input = 0;
  for (NodeId id = 0; id < graph.size(); ++id) {
    const Node& n = graph[id];
    const auto operand = [&](std::size_t i) { return n.args[i] == no_node ? W{0} : value[n.args[i]]; };
    if (n.op == Op::input) value[id] = inputs[next_input++];
    with_operation<W>(graph, n, run_body, [&](const auto& operation) {
      value[id] = operation(operand(0), operand(1), operand(2));
    });
    value[id] &= ones_below<W>(n.width);
  }
  return value;
}

template <class W>
std::vector<std::uint64_t> evaluate_in(const Graph& graph, std::span<const std::uint64_t> inputs) {
  const std::vector<W> value = values_in<W>(graph, inputs);
  std::vector<std::uint64_t> results;
  for (const Output& out : graph.outputs()) results.push_back(static_cast<std::uint64_t>(value[out.node]));
  return results;
}

void check_inputs(const Graph& graph, std::span<const std::uint64_t> inputs) {
  if (inputs.size() != graph.inputs().size()) {
    throw std::invalid_argument(fmt::format("graph {}: {} input values for {} inputs", graph.name(),
                                            inputs.size(), graph.inputs().size()));
  }
  const auto check_port = [&](NodeId id, std::string_view port) {
    if (graph[id].width > most_port_bits)
      throw std::invalid_argument(fmt::format("graph {}: port {} has {} bits, evaluated are 1 to {}",
                                              graph.name(), port, graph[id].width, most_port_bits));
  };
  for (const NodeId id : graph.inputs()) check_port(id, graph[id].name);
  for (const Output& out : graph.outputs()) check_port(out.node, out.name);
}

}  // namespace

std::vector<Word> evaluate_nodes(const Graph& graph, std::span<const std::uint64_t> inputs) {
  check_inputs(graph, inputs);
  return values_in<Word>(graph, inputs);
}

std::vector<std::uint64_t> evaluate(const Graph& graph, std::span<const std::uint64_t> inputs) {
  check_inputs(graph, inputs);
  return graph.widest() > 64 ? evaluate_in<Word>(graph, inputs) : evaluate_in<std::uint64_t>(graph, inputs);
}

}  // namespace hitpipe::rtl
