// What the software of all binary32 designs shares: boxes as they are, and what a scene tells about operands,
// by role.
#pragma once

#include "sim/software/software.hpp"

namespace hitpipe::sim {

/// The software of a binary32 design without its own set-up: feed, box_test and traversal are missing.
[[nodiscard]] Software fp_design_software();

}  // namespace hitpipe::sim
