// Divides the logic of a component into a given number of stages, as evenly as its nodes allow.
#pragma once

#include "rtl_gen/schedule/schedule.hpp"

namespace hitpipe::rtl {

/// Schedules as soon as possible under the shortest clock that needs no more than `stages`. Time is counted
/// in gate levels (rtl_gen/schedule/logic_levels.json), since a library gives one delay for all
/// stages of a component and says nothing of its inside. Shallow logic ends before the last stage; its result
/// then waits in the stages that are left.
[[nodiscard]] Schedule balance(const Graph& graph, int stages);

}  // namespace hitpipe::rtl
