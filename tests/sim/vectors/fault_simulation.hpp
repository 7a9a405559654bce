// Runs a graph with faults on a list of vectors and tells which of them shows a fault.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "tests/sim/vectors/fault.hpp"

namespace hitpipe::sim {

class FaultSimulation {
 public:
  /// Operands in port order. The graph must outlive it.
  FaultSimulation(const rtl::Graph& graph, const std::vector<std::vector<std::int64_t>>& operands);

  /// What the right graph gives for one vector, in the order of its outputs.
  [[nodiscard]] std::vector<std::uint64_t> outputs(std::size_t vector) const;
  /// The first vector for which an output is wrong; nothing when none is.
  [[nodiscard]] std::optional<std::size_t> shown_by(const Fault& fault);

 private:
  const rtl::Graph& graph_;
  std::vector<rtl::GraphLanes> batches_;
};

}  // namespace hitpipe::sim
