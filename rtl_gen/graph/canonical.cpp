#include "rtl_gen/graph/canonical.hpp"

#include <algorithm>

namespace hitpipe::rtl {

namespace {

/// For every node, the number of low bits on which some output depends; 0: none.
std::vector<int> needed_low_bits(const Graph& graph) {
  std::vector<int> need(graph.size(), 0);
  const auto ask = [&](NodeId id, int bits) {
    need[id] = std::max(need[id], std::min(bits, graph[id].width));
  };
  for (const Output& out : graph.outputs()) ask(out.node, graph[out.node].width);
  for (NodeId id = graph.size(); id-- > 0;) {
    const Node& n = graph[id];
    if (need[id] == 0) continue;
    switch (n.op) {
      case Op::slice:
        ask(n.args[0], n.low + need[id]);
        break;
      case Op::concat:
        ask(n.args[1], need[id]);
        if (need[id] > graph[n.args[1]].width) ask(n.args[0], need[id] - graph[n.args[1]].width);
        break;
      case Op::mul:
      case Op::less:
      case Op::equal:
      case Op::call:
        for (const NodeId arg : n.operands()) ask(arg, graph[arg].width);
        break;
      default:
        for (const NodeId arg : n.operands()) ask(arg, need[id]);
    }
  }
  return need;
}

class Rebuild {
 public:
  explicit Rebuild(const Graph& from)
      : from_(from), to_(from.name()), need_(needed_low_bits(from)), done_(from.size(), no_node) {
    for (const NodeId id : from.inputs())
      done_[id] = to_.input(from[id].name, from[id].width, from[id].is_signed);
    for (const Output& out : from.outputs()) to_.output(out.name, low_bits(out.node, from[out.node].width));
  }
  [[nodiscard]] Graph take() { return std::move(to_); }

 private:
  NodeId low_bits(NodeId old, int bits) {
    const NodeId id = visit(old);
    return to_.slice(id, bits - 1, 0);
  }

  NodeId visit(NodeId old) {
    if (done_[old] != no_node) return done_[old];
    const Node& n = from_[old];
    const NodeId made = make(old, need_[old]);
    to_.annotate_as(made, n);
    return done_[old] = made;
  }

  NodeId make(NodeId old, int bits) {
    const Node& n = from_[old];
    const auto width = [&](int i) { return from_[n.args[static_cast<std::size_t>(i)]].width; };
    switch (n.op) {
      case Op::input:
        break;  // recorded by the constructor
      case Op::constant:
        return to_.constant(bits, n.value);
      case Op::slice:
        return to_.slice(visit(n.args[0]), n.low + bits - 1, n.low);
      case Op::concat: {
        if (bits <= width(1)) return low_bits(n.args[1], bits);
        const NodeId high = low_bits(n.args[0], bits - width(1));
        return to_.concat(high, low_bits(n.args[1], width(1)));
      }
      case Op::extend:
        if (bits <= width(0)) return low_bits(n.args[0], bits);
        return to_.extend(low_bits(n.args[0], width(0)), bits, n.is_signed);
      case Op::invert:
        return to_.invert(low_bits(n.args[0], bits));
      case Op::mux: {
        const NodeId select = visit(n.args[0]);
        const NodeId if_one = low_bits(n.args[1], bits);
        const NodeId if_zero = low_bits(n.args[2], bits);
        to_.begin_stage(n.min_stage);
        return to_.mux(select, if_one, if_zero);
      }
      case Op::call: {
        std::vector<NodeId> operands;
        for (const NodeId arg : n.operands()) operands.push_back(low_bits(arg, from_[arg].width));
        to_.begin_stage(n.min_stage);
        return to_.call(from_.submodule_of(old), operands);
      }
      default: {
        const bool whole = n.op == Op::mul || n.op == Op::less || n.op == Op::equal;
        const NodeId a = low_bits(n.args[0], whole ? width(0) : bits);
        const NodeId b = low_bits(n.args[1], whole ? width(1) : bits);
        to_.begin_stage(n.min_stage);
        return to_.binary(n.op, a, b, n.is_signed);
      }
    }
    return no_node;
  }

  const Graph& from_;
  Graph to_;
  std::vector<int> need_;
  std::vector<NodeId> done_;
};

}  // namespace

Graph canonical(const Graph& graph) {
  // Narrower arms can make a mux superfluous, and narrower wires can cancel each other. What only those read
  // is then dead, yet it has asked for bits: repeat until nothing changes.
  Graph made = Rebuild(graph).take();
  for (std::string before; before != to_text(made);) {
    before = to_text(made);
    made = Rebuild(made).take();
  }
  return made;
}

}  // namespace hitpipe::rtl
