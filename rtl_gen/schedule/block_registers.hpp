// Registers that lie in the multiplier blocks of a chip, as Yosys puts them there.
#pragma once

#include "rtl_gen/component/library.hpp"
#include "rtl_gen/schedule/registers.hpp"
#include "rtl_gen/schedule/schedule.hpp"

namespace hitpipe::rtl {

/// Marks the registers that only blocks read, and those behind a block. A block has no register for some bits
/// of its product alone, so a register behind it begins at bit 0; nothing reads the bits that are added.
/// Without a chip, or without registers in its blocks, nothing changes.
void use_block_registers(Placement& placement, const Graph& graph, const Schedule& schedule,
                         const Library& library);

}  // namespace hitpipe::rtl
