// What the testbenches of a core are given.
#pragma once

#include <cstdint>

#include "rtl_gen/core/core.hpp"
#include "rtl_gen/core/files.hpp"

namespace hitpipe::sim {

inline constexpr int usual_core_cycles = 4000;

/// Random rays go through a mesh of random triangles, as many as the core's numbers of blocks and its
/// levels allow, 200 at most. In the cycles memory has a random latency and refuses requests, answers are not
/// always taken, and outputs are the software's. The scene has 1000 such rays, with answers by exact tests of
/// all triangles.
[[nodiscard]] rtl::CoreTest core_test(const rtl::Core& core, int cycles, std::uint64_t seed);

}  // namespace hitpipe::sim
