// A datapath ready to be emitted: canonical graph, stages, registers, shared components.
#pragma once

#include "rtl_gen/component/library.hpp"
#include "rtl_gen/graph/graph.hpp"
#include "rtl_gen/schedule/registers.hpp"
#include "rtl_gen/schedule/schedule.hpp"
#include "rtl_gen/schedule/sharing.hpp"

namespace hitpipe::rtl {

struct Pipeline {
  Graph graph;
  Schedule schedule;
  Placement placement;
  Binding binding{};

  /// A test may begin every so many cycles.
  [[nodiscard]] int interval() const { return binding.interval; }
  /// Cycles from the clock edge that latches the operands to the edge that latches the outputs: the thesis's
  /// number of pipeline stages (section 7.4).
  [[nodiscard]] int latency() const { return schedule.stages; }
};

/// On a chip, products are made as rtl_gen/component/product.hpp plans them. With an interval of more than
/// one cycle, operations share components where that makes the unit smaller, also those of several widths
/// (rtl_gen/schedule/least_area.hpp, wider.hpp). Without a clock it is the shortest; but on a chip whose
/// registers take cells of their own, as in iCE40, one up to a quarter longer where the unit then takes less
/// cells times time. Throws as schedule_modulo() does.
[[nodiscard]] Pipeline make_pipeline(const Graph& traced, const Library& library,
                                     std::optional<int> clock_ps = std::nullopt, int interval = 1);

/// What the slowest component needs, and a register.
[[nodiscard]] int shortest_clock_ps(const Graph& traced, const Library& library, int interval = 1);

}  // namespace hitpipe::rtl
