// Operands of an integer unit on coarser axes.
#pragma once

#include <vector>

#include "rtl_gen/catalogue/port.hpp"
#include "sim/feeds/with_step.hpp"
#include "sw_ref/quantise/coarse_axes.hpp"

namespace hitpipe::sim {

/// Moves origin and box, wherever the ports lie, as coarse_origin() and coarse_box() do. Throws
/// std::invalid_argument for ports that are no integer unit's, or more dropped bits than these have.
[[nodiscard]] OperandStep coarse_step(const std::vector<rtl::Port>& ports, const ref::CoarseAxes& coarse);

}  // namespace hitpipe::sim
