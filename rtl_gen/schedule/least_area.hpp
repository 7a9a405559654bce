// Which operations share components: as many as make the unit smaller. A shared component needs multiplexers
// and latches before it, and operations that wait for it leave values in registers for longer.
#pragma once

#include <cstdint>
#include <functional>

#include "rtl_gen/schedule/sharing.hpp"

namespace hitpipe::rtl {

/// In square micrometres or, of a chip, in cells: a lookup table, a register, and what a multiplier block is
/// worth in lookup tables (Block::luts).
struct SharingPrices {
  std::function<std::int64_t(Component, int bits)> part;
  std::function<std::int64_t(NodeId)> operation;  ///< of the component that carries it out
  int tag_bits = 16;                              ///< latched every `interval` stages
};

[[nodiscard]] SharingPrices sharing_prices(const Graph& graph, const Library& library, int clock_ps);

/// Components, multiplexers and latches before shared ones, and the registers of every stage. Gates are left
/// out: no schedule changes them.
[[nodiscard]] std::int64_t area_of(const Graph& graph, const SharedSchedule& shared,
                                   const SharingPrices& prices);

/// The kind of operation whose components cost most comes first. For each kind it tries every number of
/// shared instances, schedules the whole graph and keeps the least area, until no kind changes. Then it lets
/// each operation wait for a stage, or for up to `longest_wait` at a time, where that makes the area less.
/// Operations keep components of their own where the clock is too short to select among them. Of eight small
/// graphs seven get the least area of all schedules and bindings, and one 3 % more (least_area_test). Throws
/// as schedule_modulo() does.
[[nodiscard]] SharedSchedule share_for_least_area(const Graph& graph, const Library& library, int interval,
                                                  const SharingPrices& prices,
                                                  std::optional<int> clock_ps = std::nullopt,
                                                  int longest_wait = 1);

}  // namespace hitpipe::rtl
