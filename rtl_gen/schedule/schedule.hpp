// The pipeline stage in which every node of a graph works.
//
// An instance is a graph and a component library. A solution gives each node the stage in which it starts,
// and the stage and the time at which its value is there. verify() checks these rules and schedule_asap()
// follows them:
//   1. Inputs come out of latches at the start of stage 1.
//   2. A combinational node (0 internal stages) works within one stage, after its operands. Operands of the
//      same stage are chained. Operands of an earlier stage come out of latches at time 0. The low bits of a
//      carry chain are there first, and a chain that begins with them need not wait for the others.
//   3. A node with L internal stages fills L consecutive stages. Its value is always latched, so it is there
//      at the start of the stage after them. Logic may be chained before its first stage.
//   4. In every stage the longest chain and an output latch fit into the clock.
//   5. Wires (slice, concat, extend, invert) and constants take no time and have no stage. A reader gets
//      them in its own stage, from the source that is live there.
//   6. A node that states an earliest stage (Node::min_stage) starts in that stage or later.
// The clock period is that of the slowest component stage and a latch, unless a caller asks for more.
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
  bool latched = false;  ///< the value can be used only from stage finish + 1 on (inputs, rule 3)
  int low_ps = 0;        ///< time within `finish` at which its lowest bit is there, if not latched
};

struct Schedule {
  int clock_ps = 0;
  int latch_ps = 0;
  int stages = 0;           ///< the outputs are latched at the end of this stage
  std::vector<Slot> slots;  ///< by node; wires and constants have none (all zero)
};

/// Every node as soon as possible, with chaining: the thesis's schedule (section 7.4). The result has passed
/// verify(). Throws std::invalid_argument when `clock_ps` is shorter than the slowest component stage and a
/// latch; the message names the component and the shortest clock that can be met.
[[nodiscard]] Schedule schedule_asap(const Graph& graph, const Library& library,
                                     std::optional<int> clock_ps = std::nullopt);

/// For a component whose author states the partition: every node starts in its min_stage or in its operands'
/// stage, whichever is later. No node takes time or has internal stages. The result has passed
/// verify_stated(). Throws std::logic_error when the graph needs more stages.
[[nodiscard]] Schedule schedule_as_stated(const Graph& graph, int stages);

/// One line for each rule that the schedule breaks; none when it is legal. It does not know how the schedule
/// was made.
[[nodiscard]] std::vector<std::string> verify(const Graph& graph, const Library& library,
                                              const Schedule& schedule);
/// The same for a schedule without time: no node takes any, and none has internal stages.
[[nodiscard]] std::vector<std::string> verify_stated(const Graph& graph, const Schedule& schedule);

}  // namespace hitpipe::rtl
