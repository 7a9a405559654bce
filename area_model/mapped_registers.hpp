// The registers of a scheduled graph on a chip. A bit that only waits goes through a shift register, which is
// a lookup table, where the chip has such.
#pragma once

#include "area_model/mapped_tables.hpp"

namespace hitpipe::area {

[[nodiscard]] MappedCells mapped_registers(const rtl::Graph& graph, const rtl::SharedSchedule& shared,
                                           const rtl::Placement& placement, const rtl::Chip& chip);
/// Those of a unit's tag.
[[nodiscard]] MappedCells mapped_tags(const rtl::Pipeline& pipeline, const rtl::Chip& chip);

}  // namespace hitpipe::area
