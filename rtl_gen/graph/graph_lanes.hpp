// Runs a graph on up to 64 vectors at a time, and again with wrong values at one node: which vectors show it?
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "rtl_gen/graph/operation.hpp"

namespace hitpipe::rtl {

inline constexpr std::size_t most_lanes = 64;
/// A value for each lane. Lanes without a vector repeat the last vector.
using Lanes = std::array<Word, most_lanes>;

class GraphLanes {
 public:
  /// The graph must outlive it.
  /// `run_submodule` computes calls; another one may be quicker.
  explicit GraphLanes(const Graph& graph, RunSubmodule run_submodule = run_body);

  /// One to 64 vectors, each with a number for each input in order; bits above an input's width are ignored.
  void load(std::span<const std::vector<std::int64_t>> operands);
  /// What the graph gives for each node.
  [[nodiscard]] const Lanes& right(NodeId id) const { return right_[id]; }
  /// A bit for each lane whose outputs change when the node has these values instead.
  [[nodiscard]] std::uint64_t shown_by(NodeId node, const Lanes& wrong);

 private:
  const Graph& graph_;
  RunSubmodule run_submodule_;
  std::vector<Lanes> right_, wrong_;
  std::vector<char> differs_;
  std::vector<std::vector<NodeId>> readers_;  ///< every node that depends on the node
};

}  // namespace hitpipe::rtl
