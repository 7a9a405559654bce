#include "rtl_gen/graph/graph_lanes.hpp"

#include <algorithm>

namespace hitpipe::rtl {

namespace {

/// Of any node but an input.
template <class LanesOf>
void run(const Graph& graph, NodeId id, RunSubmodule run_submodule, const LanesOf& lanes_of, Lanes& out) {
  const Node& n = graph[id];
  const Word mask = ones_below(n.width);
  const auto operand = [&](std::size_t i) -> const Lanes& {
    return n.args[i] == no_node ? out : lanes_of(n.args[i]);
  };
  const Lanes& a = operand(0);
  const Lanes& b = operand(1);
  const Lanes& c = operand(2);
  with_operation<Word>(graph, n, run_submodule, [&](const auto& operation) {
    for (std::size_t i = 0; i < most_lanes; ++i) out[i] = operation(a[i], b[i], c[i]) & mask;
  });
}

}  // namespace

GraphLanes::GraphLanes(const Graph& graph, RunSubmodule run_submodule)
    : graph_(graph),
      run_submodule_(run_submodule),
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
    const Word mask = ones_below(graph_[id].width);
    for (std::size_t i = 0; i < most_lanes; ++i)
      right_[id][i] = static_cast<Word>(operands[std::min(i, operands.size() - 1)][input]) & mask;
  }
  for (NodeId id = 0; id < graph_.size(); ++id) {
    const auto lanes_of = [&](NodeId arg) -> const Lanes& { return right_[arg]; };
    run(graph_, id, run_submodule_, lanes_of, right_[id]);
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
    run(graph_, id, run_submodule_, lanes_of, wrong_[id]);
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
