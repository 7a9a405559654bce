// When the operands of a node are there.
#pragma once

#include <algorithm>

#include "rtl_gen/graph/sources.hpp"
#include "rtl_gen/schedule/schedule.hpp"

namespace hitpipe::rtl {

struct Start {
  int stage;
  int time_ps;  ///< within the stage
};

/// The first stage in which a node can start, and when in it. The slots of its operands are known.
[[nodiscard]] inline Start earliest_start(const Graph& graph, const Schedule& schedule, NodeId id) {
  Start start{.stage = std::max(1, graph[id].min_stage), .time_ps = 0};
  for_each_source(graph, id, [&](NodeId source, Word) {
    const Slot& from = schedule.slots[source];
    const int there = from.latched ? from.finish + 1 : from.finish;
    const int at_ps = from.latched ? 0 : from.ready_ps;
    if (there > start.stage) start.time_ps = 0;
    if (there >= start.stage) start.time_ps = std::max(start.time_ps, at_ps);
    start.stage = std::max(start.stage, there);
  });
  return start;
}

/// The stage that latches the last output.
[[nodiscard]] inline int last_stage(const Graph& graph, const Schedule& schedule) {
  int last = 1;
  for (const Output& out : graph.outputs())
    for_each_source_of(graph, out.node,
                       [&](NodeId source, Word) { last = std::max(last, schedule.slots[source].finish); });
  return last;
}

}  // namespace hitpipe::rtl
