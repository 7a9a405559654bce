// A core as files: Verilog, manifest, FuseSoC core, and a testbench that compares its outputs in every cycle.
#pragma once

#include <vector>

#include "host/files.hpp"
#include "rtl_gen/component/library.hpp"
#include "rtl_gen/core/core.hpp"
#include "rtl_gen/core/system.hpp"
#include "rtl_gen/emit/vectors.hpp"
#include "rtl_gen/machine/cycle_bench.hpp"

namespace hitpipe::rtl {

/// What the testbenches of a core need.
struct CoreTest {
  std::vector<MachineCycle> cycles;  ///< ports in the core's order; the first cycle resets
  CoreScene scene;                   ///< for the system around MODULE_axi
  std::vector<VectorSet> units;      ///< for its first units, in the order of its parts
};

/// MODULE.v, MODULE_axi.v, MODULE.h, MODULE.rdl, MODULE.json, MODULE.core, MODULE.dot, MODULE_axi.dot, and in tb:
/// MODULE_tb.sv, MODULE_vectors.hex, the folder MODULE_axi_harness, MODULE_scene.txt, Makefile, and UNIT_tb.sv and
/// UNIT_vectors.hex of each unit. The same bytes for the same arguments.
[[nodiscard]] std::vector<host::File> core_files(const Core& core, const Library& library, CoreTest test);

}  // namespace hitpipe::rtl
