// Which pipeline stage every node of a graph works in.
//
// An instance is a graph and a component library. A solution gives each node the stage it starts in and the
// stage and time at which its value is there. The rules, which verify() checks and schedule_asap() follows:
//   1. Inputs come out of latches at the start of stage 1.
//   2. A combinational node (0 internal stages) works within one stage, after its operands: operands of the
//   same stage
//      are chained, those of an earlier stage come out of latches at time 0.
//   3. A node with L internal stages fills L consecutive stages; its value is always latched, so it is there
//   at the
//      start of the stage after. Logic may be chained before its first stage.
//   4. In every stage the longest chain and an output latch fit into the clock.
//   5. Wires (slice, concat, extend, invert) and constants take no time and have no stage of their own: they
//   are taken
//      in the stage of their reader, from the source that is live there.
// The clock is that of the slowest component stage and a latch unless a caller asks for a slower one.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "rtl_gen/component/library.hpp"
#include "rtl_gen/graph/graph.hpp"

namespace hitpipe::rtl {

struct Slot {
  int stage = 0;         ///< first stage the node works in; inputs: 0
  int finish = 0;        ///< last one; inputs: 0
  int ready_ps = 0;      ///< time within `finish` at which the value is there, if not latched
  bool latched = false;  ///< the value can be used from stage finish + 1 on only (inputs, rule 3)
};

struct Schedule {
  int clock_ps = 0;
  int latch_ps = 0;
  int stages = 0;           ///< the outputs are latched at the end of this stage
  std::vector<Slot> slots;  ///< by node; wires and constants have none (all zero)
};

/// As soon as possible with chaining: the thesis's schedule (section 7.4).
/// Throws std::invalid_argument when `clock_ps` is shorter than the slowest component stage and a latch; the
/// message names the component and the smallest clock that can be met. The result has passed verify().
[[nodiscard]] Schedule schedule_asap(const Graph& graph, const Library& library,
                                     std::optional<int> clock_ps = std::nullopt);

/// For a component whose partition its author states: every node starts in its min_stage or in its operands'
/// stage, whichever is later. Time is not modelled inside a component.
[[nodiscard]] Schedule schedule_as_stated(const Graph& graph, int stages);

/// Every rule that the schedule breaks, a line each; empty: it is legal. Knows nothing of how the schedule
/// was made.
[[nodiscard]] std::vector<std::string> verify(const Graph& graph, const Library& library,
                                              const Schedule& schedule);

}  // namespace hitpipe::rtl
