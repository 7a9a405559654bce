// What the testbenches of a core are given.
#pragma once

#include <cstdint>

#include "rtl_gen/core/core.hpp"
#include "rtl_gen/core/files.hpp"

namespace hitpipe::sim {

inline constexpr int usual_core_cycles = 4000;

/// Rays of all lengths go through two meshes, as large as the core's numbers of blocks and its levels allow: 200 random
/// triangles at most, and 40 on a lattice, where rays meet edges and corners and tie. In the cycles memory has a random
/// latency and refuses requests, answers are not always taken, and rays have gaps. Some rays are none, some images are cut
/// or damaged, some reads are errors, and steps run out. The image is at several places, the last of the address space
/// among them. Outputs are the software's. The scene has 1000 rays of both kinds, with answers by exact tests of all triangles.
[[nodiscard]] rtl::CoreTest core_test(const rtl::Core& core, int cycles, std::uint64_t seed);

}  // namespace hitpipe::sim
