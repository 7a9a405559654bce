// A datapath ready to be emitted: canonical graph, stages, registers.
#pragma once

#include "rtl_gen/component/library.hpp"
#include "rtl_gen/graph/graph.hpp"
#include "rtl_gen/schedule/registers.hpp"
#include "rtl_gen/schedule/schedule.hpp"

namespace hitpipe::rtl {

struct Pipeline {
  Graph graph;
  Schedule schedule;
  Placement placement;

  /// Cycles from the clock edge that latches the operands to the edge that latches the outputs: the thesis's
  /// number of pipeline stages (section 7.4).
  [[nodiscard]] int latency() const { return schedule.stages; }
};

/// On a chip, products are made as rtl_gen/component/product.hpp plans them. Throws as schedule_asap does.
[[nodiscard]] Pipeline make_pipeline(const Graph& traced, const Library& library,
                                     std::optional<int> clock_ps = std::nullopt);

}  // namespace hitpipe::rtl
