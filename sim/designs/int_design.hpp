// What the software of all n/t designs shares: formats, boxes on the grid, and what a scene tells about
// operands, by role.
#pragma once

#include "sim/software/software.hpp"

namespace hitpipe::sim {

/// The software of an n/t design without its own set-up: feed, box_test and tracer are missing.
[[nodiscard]] Software int_design_software();

}  // namespace hitpipe::sim
