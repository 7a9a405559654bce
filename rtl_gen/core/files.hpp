// A core as files: Verilog, manifest, FuseSoC core, and a testbench that compares its outputs in every cycle.
#pragma once

#include <vector>

#include "host/files.hpp"
#include "rtl_gen/component/library.hpp"
#include "rtl_gen/core/core.hpp"
#include "rtl_gen/machine/cycle_test.hpp"

namespace hitpipe::rtl {

/// MODULE.v, MODULE.json, MODULE.core, tb/MODULE_tb.sv, tb/MODULE_vectors.hex, tb/Makefile. `cycles` are
/// those of the testbench: inputs and outputs in the order of the core's ports, the first one a reset. The
/// same bytes for the same arguments.
[[nodiscard]] std::vector<host::File> core_files(const Core& core, const Library& library,
                                                 std::vector<MachineCycle> cycles);

}  // namespace hitpipe::rtl
