// Cycles for the testbench of a core.
#pragma once

#include <cstdint>
#include <vector>

#include "rtl_gen/core/core.hpp"
#include "rtl_gen/machine/cycle_test.hpp"

namespace hitpipe::sim {

inline constexpr int usual_core_cycles = 4000;

/// The first is a reset. Then random rays go through a mesh of random triangles, as many as the core's
/// numbers of blocks allow, 200 at most. Memory has a random latency and refuses requests, and answers are
/// not always taken. Outputs are the software's.
[[nodiscard]] std::vector<rtl::MachineCycle> core_cycles(const rtl::Core& core, int cycles,
                                                         std::uint64_t seed);

}  // namespace hitpipe::sim
