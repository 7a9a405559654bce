// What the testbenches of a core are given.
#pragma once

#include <cstdint>

#include "rtl_gen/core/core.hpp"
#include "rtl_gen/core/files.hpp"

namespace hitpipe::sim {

inline constexpr int usual_core_cycles = 4000;

/// Rays of all lengths go through three meshes, as large as the core's numbers of blocks and its levels allow: 200
/// triangles at most, most of them random; 40 on a lattice, where rays meet edges and corners and tie; and 120 in a
/// hierarchy with as many levels as the core. In the cycles memory has a random latency and refuses requests, answers are
/// not always taken, and rays have gaps. Some rays are none or have other numbers in their fields, some images are cut or
/// damaged, some reads are errors, and steps run out. There may be more rays than the core has room for. The image is at
/// several places, the last of the address space among them. Outputs are the software's. The scene is the first mesh, with
/// 1000 rays and their answers by exact tests of all triangles. Each unit has vectors of design_vectors().
[[nodiscard]] rtl::CoreTest core_test(const rtl::Core& core, int cycles, std::uint64_t seed);

}  // namespace hitpipe::sim
