// Maps a traversal core to a target, as a unit is mapped.
#pragma once

#include <cstdint>

#include "rtl_gen/core/core.hpp"
#include "sim/implement/unit_implementation.hpp"

namespace hitpipe::sim {

struct CoreImplementation {
  Implementation chip;
  int clock_ps = 0;              ///< that its units are scheduled for
  std::int64_t memory_bits = 0;  ///< of the memories that its machines declare
};

/// Writes the core's Verilog and all that the tools read and wrote as implement_unit() does, and throws as it
/// and rtl::make_core() do. Options that only units have are not used.
[[nodiscard]] CoreImplementation implement_core(const rtl::CoreOptions& core_options, const Target& target,
                                                const ImplementOptions& options);

}  // namespace hitpipe::sim
