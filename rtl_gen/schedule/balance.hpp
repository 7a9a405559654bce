// Divides a component's own logic into a given number of stages, as evenly as its nodes allow.
#pragma once

#include "rtl_gen/schedule/schedule.hpp"

namespace hitpipe::rtl {

/// As soon as possible under the smallest clock that needs no more than `stages`. Time is counted in gate
/// levels (area_model/libraries/logic_levels.json): a library gives a component one delay for all its stages,
/// nothing of its inside. Logic too shallow to fill the stages ends early; its result waits in the last ones.
[[nodiscard]] Schedule balance(const Graph& graph, int stages);

}  // namespace hitpipe::rtl
