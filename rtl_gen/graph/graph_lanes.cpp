#include "rtl_gen/graph/graph_lanes.hpp"

#include <algorithm>

#include "hls/num/bits.hpp"

namespace hitpipe::rtl {

namespace {

/// The operands of a node.
struct Read {
  std::array<const Lanes*, 3> of{};
  int width_a = 0;
  int width_b = 0;
};

template <class LanesOf>
Read read(const Graph& graph, const Node& node, LanesOf&& lanes_of) {
  Read in;
  for (std::size_t i = 0; i < node.operands().size(); ++i) in.of[i] = &lanes_of(node.args[i]);
  if (node.arity() > 0) in.width_a = graph[node.args[0]].width;
  if (node.arity() > 1) in.width_b = graph[node.args[1]].width;
  return in;
}

/// Of any node but an input.
void run(const Graph& graph, NodeId id, const Read& in, RunUnit run_unit, Lanes& out) {
  const Node& n = graph[id];
  const std::uint64_t mask = hls::low_mask(n.width);
  const auto all = [&](auto&& function) {
    for (std::size_t i = 0; i < most_lanes; ++i) out[i] = static_cast<std::uint64_t>(function(i)) & mask;
  };
  const auto a = [&](std::size_t i) { return (*in.of[0])[i]; };
  const auto b = [&](std::size_t i) { return (*in.of[1])[i]; };
  const auto signed_a = [&](std::size_t i) { return hls::sign_extended(a(i), in.width_a); };
  const auto signed_b = [&](std::size_t i) { return hls::sign_extended(b(i), in.width_b); };
  switch (n.op) {
    case Op::input:
      return;
    case Op::constant:
      return all([&](std::size_t) { return n.value; });
    case Op::slice:
      return all([&](std::size_t i) { return a(i) >> n.low; });
    case Op::concat:
      return all([&](std::size_t i) { return a(i) << in.width_b | b(i); });
    case Op::extend:
      return n.is_signed ? all(signed_a) : all(a);
    case Op::invert:
      return all([&](std::size_t i) { return ~a(i); });
    case Op::bit_and:
      return all([&](std::size_t i) { return a(i) & b(i); });
    case Op::bit_or:
      return all([&](std::size_t i) { return a(i) | b(i); });
    case Op::bit_xor:
      return all([&](std::size_t i) { return a(i) ^ b(i); });
    case Op::add:
      return all([&](std::size_t i) { return a(i) + b(i); });
    case Op::sub:
      return all([&](std::size_t i) { return a(i) - b(i); });
    case Op::mul:
      if (!n.is_signed) return all([&](std::size_t i) { return a(i) * b(i); });
      return all([&](std::size_t i) {
        return static_cast<std::uint64_t>(signed_a(i)) * static_cast<std::uint64_t>(signed_b(i));
      });
    case Op::less:
      return n.is_signed ? all([&](std::size_t i) { return signed_a(i) < signed_b(i); })
                         : all([&](std::size_t i) { return a(i) < b(i); });
    case Op::equal:
      return all([&](std::size_t i) { return a(i) == b(i); });
    case Op::mux:
      return all([&](std::size_t i) { return a(i) != 0 ? b(i) : (*in.of[2])[i]; });
    case Op::call:
      return all([&](std::size_t i) {
        std::array<std::uint64_t, 3> operands{};
        const auto arity = static_cast<std::size_t>(n.arity());
        for (std::size_t k = 0; k < arity; ++k) operands[k] = (*in.of[k])[i];
        return run_unit(*graph.unit_of(id), {operands.data(), arity});
      });
  }
}

}  // namespace

std::uint64_t run_body(const Unit& unit, std::span<const std::uint64_t> operands) {
  return evaluate(unit.body, operands).front();
}

GraphLanes::GraphLanes(const Graph& graph, RunUnit run_unit)
    : graph_(graph),
      run_unit_(run_unit),
      right_(graph.size()),
      wrong_(graph.size()),
      differs_(graph.size()),
      readers_(graph.size()) {
  for (NodeId id = 0; id < graph.size(); ++id) {
    std::vector<char> depends(graph.size());
    depends[id] = 1;
    for (NodeId later = id + 1; later < graph.size(); ++later) {
      for (const NodeId arg : graph[later].operands())
        if (depends[arg] != 0) depends[later] = 1;
      if (depends[later] != 0) readers_[id].push_back(later);
    }
  }
}

void GraphLanes::load(std::span<const std::vector<std::int64_t>> operands) {
  for (std::size_t input = 0; input < graph_.inputs().size(); ++input) {
    const NodeId id = graph_.inputs()[input];
    const std::uint64_t mask = hls::low_mask(graph_[id].width);
    for (std::size_t i = 0; i < most_lanes; ++i)
      right_[id][i] = static_cast<std::uint64_t>(operands[std::min(i, operands.size() - 1)][input]) & mask;
  }
  for (NodeId id = 0; id < graph_.size(); ++id) {
    const auto lanes_of = [&](NodeId arg) -> const Lanes& { return right_[arg]; };
    run(graph_, id, read(graph_, graph_[id], lanes_of), run_unit_, right_[id]);
  }
}

std::uint64_t GraphLanes::shown_by(NodeId node, const Lanes& wrong) {
  if (wrong == right_[node]) return 0;
  wrong_[node] = wrong;
  differs_[node] = 1;
  const auto lanes_of = [&](NodeId id) -> const Lanes& {
    return differs_[id] != 0 ? wrong_[id] : right_[id];
  };
  for (const NodeId id : readers_[node]) {
    const auto args = graph_[id].operands();
    if (std::none_of(args.begin(), args.end(), [&](NodeId arg) { return differs_[arg] != 0; })) continue;
    run(graph_, id, read(graph_, graph_[id], lanes_of), run_unit_, wrong_[id]);
    differs_[id] = wrong_[id] == right_[id] ? 0 : 1;
  }
  std::uint64_t shown = 0;
  for (const Output& out : graph_.outputs()) {
    for (std::size_t i = 0; differs_[out.node] != 0 && i < most_lanes; ++i)
      if (wrong_[out.node][i] != right_[out.node][i]) shown |= std::uint64_t{1} << i;
  }
  differs_[node] = 0;
  for (const NodeId id : readers_[node]) differs_[id] = 0;
  return shown;
}

}  // namespace hitpipe::rtl
