// What the testbenches of a core are given.
#pragma once

#include <cstdint>

#include "rtl_gen/core/core.hpp"
#include "rtl_gen/core/files.hpp"

namespace hitpipe::sim {

inline constexpr int usual_core_cycles = 6000;

/// What the testbenches replay. Images are as large as the core's numbers of blocks and its levels allow. In the
/// cycles, which are in nine parts, rays are aimed at triangles, meet edges and corners and tie, have other numbers in
/// their fields, or are none. They walk through short trees and long chains, so that stacks run over and walks begin
/// again. Memory has a random latency, refuses requests and gives errors; answers are not always taken; rays have gaps,
/// or there are more than the core has room for. Some images are cut or damaged, and steps run out. The image is at
/// several places, the last of the address space among them. Outputs are the software's. The scene has 1000 rays, with
/// answers by exact tests of all triangles and the blocks that a walk in software reads. Each unit has vectors of
/// design_vectors().
[[nodiscard]] rtl::CoreTest core_test(const rtl::Core& core, int cycles, std::uint64_t seed);

}  // namespace hitpipe::sim
