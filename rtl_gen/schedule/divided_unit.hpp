// A unit divided into pipeline stages. A library of cells says how many there are, and gate levels say where
// they begin. On a chip both follow from the delays of the chip's parts.
#pragma once

#include <optional>

#include "rtl_gen/component/library.hpp"
#include "rtl_gen/schedule/registers.hpp"
#include "rtl_gen/schedule/schedule.hpp"

namespace hitpipe::rtl {

struct DividedUnit {
  Graph body;
  Schedule schedule;
  Placement placement;
};

/// In as many stages as timing_of_unit() gives.
[[nodiscard]] DividedUnit divided(const Submodule& unit, const Library& library, int clock_ps);

/// Delay of the slowest stage, and stages. On a chip the unit has as few stages as the clock allows. Without
/// a clock it is that of its own slowest part and a latch.
[[nodiscard]] Cell timing_of_unit(const Submodule& unit, const Library& library,
                                  std::optional<int> clock_ps = std::nullopt);

/// The time that the nodes of one graph take. Each unit is divided once.
class NodeTiming {
 public:
  NodeTiming(const Graph& graph, const Library& library, std::optional<int> clock_ps = std::nullopt);
  [[nodiscard]] Cell operator()(NodeId node) const;

 private:
  const Graph& graph_;
  const Library& library_;
  std::vector<Cell> units_;  ///< in the order of graph.submodules()
};

/// Schedules as soon as possible under the shortest clock that needs no more than `stages`. Time is counted
/// in gate levels (rtl_gen/schedule/logic_levels.json), since a library gives one delay for all
/// stages of a component and says nothing of its inside. Shallow logic ends before the last stage; its result
/// then waits in the stages that are left.
[[nodiscard]] Schedule balance(const Graph& graph, int stages);

}  // namespace hitpipe::rtl
