// How many lookup tables a scheduled graph takes on a chip after mapping. Gates and multiplexers of one stage share
// tables. Those before an adder go into the adder's tables where the chip can do that. Registers in which a value only
// waits become shift registers.
#pragma once

#include <map>
#include <utility>

#include "area_model/count.hpp"

namespace hitpipe::area {

/// By stage and part, what all those parts take together. Multiplier blocks and what is no part of the graph,
/// such as tags, are not there.
using MappedCells = std::map<std::pair<int, Part>, rtl::ChipCells>;

[[nodiscard]] MappedCells mapped_cells(const rtl::Graph& graph, const rtl::SharedSchedule& shared,
                                       const rtl::Placement& placement, const rtl::Chip& chip);

}  // namespace hitpipe::area
