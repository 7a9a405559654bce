// Maps a traversal core to a target, as a unit is mapped: alone, and behind AXI.
#pragma once

#include <cstdint>

#include "rtl_gen/core/core.hpp"
#include "sim/implement/unit_implementation.hpp"

namespace hitpipe::sim {

struct MappedCore {
  Implementation chip;
  std::int64_t memory_bits = 0;  ///< of the memories that its machines declare
};

struct CoreImplementation {
  MappedCore core;
  MappedCore axi;    ///< the AXI wrapper with the core in it
  int clock_ps = 0;  ///< that the core's units are scheduled for
};

/// Writes the Verilog of both and all that the tools read and wrote as implement_unit() does, and throws as it
/// and rtl::make_core() do; a line about a tool begins with the module. Options that only units have are not
/// used.
[[nodiscard]] CoreImplementation implement_core(const rtl::CoreOptions& core_options, const Target& target,
                                                const ImplementOptions& options);

}  // namespace hitpipe::sim
