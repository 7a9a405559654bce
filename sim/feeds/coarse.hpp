// Operands of an integer unit on coarser axes.
#pragma once

#include <vector>

#include "rtl_gen/catalogue/port.hpp"
#include "sim/feeds/with_step.hpp"
#include "sw_ref/quantise/coarse_axes.hpp"

namespace hitpipe::sim {

/// Changes origin and box as coarse_origin() and coarse_box() do; finds their ports by role. Throws
/// std::invalid_argument when the ports are not those of an integer unit, or have fewer bits than are to be
/// dropped.
[[nodiscard]] OperandStep coarse_step(const std::vector<rtl::Port>& ports, const ref::CoarseAxes& coarse);

}  // namespace hitpipe::sim
