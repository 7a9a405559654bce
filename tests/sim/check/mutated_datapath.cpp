#include <stdexcept>
#include <vector>

#include "tests/sim/check/mutations.hpp"

namespace hitpipe::sim {

namespace {

using rtl::Graph;
using rtl::no_node;
using rtl::Node;
using rtl::NodeId;
using rtl::Op;

}  // namespace

NodeId copied(Graph& to, const Node& node, Args args) {
  switch (node.op) {
    case Op::input:
      return to.input(node.name, node.width, node.is_signed);
    case Op::constant:
      return to.constant(node.width, node.value);
    case Op::slice:
      return to.slice(args[0], node.low + node.width - 1, node.low);
    case Op::concat:
      return to.concat(args[0], args[1]);
    case Op::extend:
      return to.extend(args[0], node.width, node.is_signed);
    case Op::invert:
      return to.invert(args[0]);
    case Op::mux:
      return to.mux(args[0], args[1], args[2]);
    case Op::call:
      throw std::logic_error("an integer design calls no unit");
    default:
      return to.binary(node.op, args[0], args[1], node.is_signed);
  }
}

Graph mutated(const Graph& right, const std::function<GraphFault>& fault) {
  Graph to(right.name());
  std::vector<NodeId> made;
  bool changed = false;
  for (NodeId id = 0; id < right.size(); ++id) {
    const Node& node = right[id];
    std::vector<NodeId> args;
    for (const NodeId arg : node.operands()) args.push_back(made[arg]);
    const NodeId faulty = fault(to, node, args);
    changed = changed || faulty != no_node;
    made.push_back(faulty != no_node ? faulty : copied(to, node, args));
  }
  if (!changed) throw std::logic_error("the fault finds no node to change");
  for (const rtl::Output& out : right.outputs()) to.output(out.name, made[out.node]);
  return to;
}

namespace {

class MutatedDatapath final : public BoxTest {
 public:
  MutatedDatapath(const rtl::Design& design, const Format& format, GraphFault* fault)
      : right_(make_box_test(design, format)),
        ports_(design.ports(format)),
        graph_(mutated(design.trace(format), fault)),
        inputs_(ports_.size()) {}

  void start(const ref::Ray& ray) override { right_->start(ray); }
  bool hit(const ref::Aabb& box) override {
    (void)right_->hit(box);
    for (std::size_t i = 0; i < inputs_.size(); ++i) {
      const std::uint64_t mask = ~std::uint64_t{0} >> (64 - ports_[i].width);
      inputs_[i] = static_cast<std::uint64_t>(right_->operands()[i]) & mask;
    }
    return rtl::evaluate(graph_, inputs_).front() != 0;
  }

 private:
  std::unique_ptr<BoxTest> right_;
  std::vector<rtl::Port> ports_;
  Graph graph_;
  std::vector<std::uint64_t> inputs_;
};

NodeId swapped_mux(Graph& to, const Node& node, std::string_view name, Args args) {
  return node.op == Op::mux && node.name == name ? to.mux(args[0], args[2], args[1]) : no_node;
}

}  // namespace

std::unique_ptr<BoxTest> mutated_datapath(const rtl::Design& design, const Format& format,
                                          GraphFault* fault) {
  return std::make_unique<MutatedDatapath>(design, format, fault);
}

NodeId near_floor_dropped(Graph& /*to*/, const Node& node, Args args) {
  return node.op == Op::mux && node.name == "ir_near_x" ? args[1] : no_node;
}

NodeId near_operands_swapped(Graph& to, const Node& node, Args args) {
  return swapped_mux(to, node, "ir_near_x", args);
}

NodeId far_from_the_near_plane(Graph& to, const Node& node, Args args) {
  return swapped_mux(to, node, "d_far_y", args);
}

NodeId edge_bound_off_by_one(Graph& to, const Node& node, Args args) {
  if (node.op != Op::less || !node.name.starts_with("outside")) return no_node;
  const Node bound = to[args[1]];
  return to.binary(Op::less, args[0], to.constant(bound.width, bound.value + 1), node.is_signed);
}

NodeId side_bit_dropped(Graph& to, const Node& node, Args args) {
  if (node.op != Op::sub || !node.name.starts_with("side")) return no_node;
  const NodeId whole = to.binary(Op::sub, args[0], args[1], node.is_signed);
  return to.extend(to.slice(whole, node.width - 2, 0), node.width, true);
}

NodeId edge_planes_swapped(Graph& to, const Node& node, Args args) {
  return swapped_mux(to, node, "q_plane_0", args);
}

NodeId last_plane_for_the_first(Graph& to, const Node& node, Args args) {
  return swapped_mux(to, node, "first_plane_z", args);
}

NodeId made_again(Graph& to, const Node& node, Args args) {
  return node.op == Op::mul ? copied(to, node, args) : no_node;
}

}  // namespace hitpipe::sim
