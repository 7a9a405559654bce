// Which clocks to try for a unit on a chip. Component libraries estimate what a chip's clock will be. A unit
// for a longer clock has fewer stages and registers, and often fits or even runs faster.
#pragma once

#include <vector>

#include "rtl_gen/catalogue/design.hpp"
#include "rtl_gen/component/library.hpp"

namespace hitpipe::sim {

/// Clocks in picoseconds for the schedules of a unit, from the library's own on. With a test in each cycle
/// each has fewer stages than the one before, at the shortest clock that gives so few. At most `most`, 2 or
/// more, which are spread over the numbers of stages down to a clock of four times the library's.
[[nodiscard]] std::vector<int> clocks_to_try(const rtl::Graph& graph, const rtl::Library& library,
                                             std::size_t most);

}  // namespace hitpipe::sim
