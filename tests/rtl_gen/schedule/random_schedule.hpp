// A scheduler that is bad on purpose: legal, but it delays nodes at random. It serves to test the verifier
// and the emitter.
#pragma once

#include <algorithm>

#include "rtl_gen/graph/sources.hpp"
#include "rtl_gen/schedule/schedule.hpp"
#include "tests/rtl_gen/seeded.hpp"

namespace hitpipe::rtl {

/// `clock_ps` must be one that schedule_asap() accepts.
inline Schedule random_schedule(const Graph& graph, const Library& library, int clock_ps, Seeded& random) {
  Schedule s;
  s.clock_ps = clock_ps;
  s.latch_ps = library.latch_delay_ps();
  s.stages = 1;
  s.slots.resize(graph.size());
  for (NodeId id = 0; id < graph.size(); ++id) {
    Slot& slot = s.slots[id];
    if (graph[id].op == Op::input) slot.latched = true;
    if (!is_root(graph[id].op) || graph[id].op == Op::input) continue;
    slot.stage = 1;
    for_each_source(graph, id, [&](NodeId source, Word) {
      const Slot& from = s.slots[source];
      slot.stage = std::max(slot.stage, from.finish + (from.latched ? 1 : 0));
    });
    slot.stage += std::max(0, random.below(8) - 5);
    int start_ps = 0;
    for_each_source(graph, id, [&](NodeId source, Word) {
      const Slot& from = s.slots[source];
      if (!from.latched && from.finish == slot.stage) start_ps = std::max(start_ps, from.ready_ps);
    });
    const Cell cell = timing_of(graph, id, library);
    if (start_ps + cell.delay_ps + s.latch_ps > clock_ps) {
      ++slot.stage;
      start_ps = 0;
    }
    slot.latched = cell.stages > 0;
    slot.finish = slot.stage + std::max(cell.stages, 1) - 1;
    slot.ready_ps = slot.latched ? 0 : start_ps + cell.delay_ps;
    s.stages = std::max(s.stages, slot.finish);
  }
  s.stages += random.below(3);
  return s;
}

}  // namespace hitpipe::rtl
