// A unit divided into pipeline stages. A library of cells says how many there are, and gate levels say where
// they begin. On a chip both follow from the delays of the chip's parts.
#pragma once

#include "rtl_gen/component/library.hpp"
#include "rtl_gen/schedule/registers.hpp"
#include "rtl_gen/schedule/schedule.hpp"

namespace hitpipe::rtl {

struct DividedUnit {
  Graph body;
  Schedule schedule;
  Placement placement;
};

/// `stages` is what timing_of_unit() gives.
[[nodiscard]] DividedUnit divided(const Unit& unit, int stages, const Library& library);

/// Delay of the slowest stage, and stages.
[[nodiscard]] Cell timing_of_unit(const Unit& unit, const Library& library);

/// The time that the nodes of one graph take. Each unit is divided once.
class NodeTiming {
 public:
  NodeTiming(const Graph& graph, const Library& library);
  [[nodiscard]] Cell operator()(NodeId node) const;

 private:
  const Graph& graph_;
  const Library& library_;
  std::vector<Cell> units_;  ///< in the order of graph.units()
};

}  // namespace hitpipe::rtl
