// Operands of a unit that never hears where a ray ends: no box ahead of the origin is too far.
#pragma once

#include <vector>

#include "rtl_gen/catalogue/port.hpp"
#include "sim/feeds/with_step.hpp"

namespace hitpipe::sim {

/// Says of every ray that it has no end: the unit ignores length or endpoint. Throws std::invalid_argument
/// for ports without an operand for that.
[[nodiscard]] OperandStep endless_step(const std::vector<rtl::Port>& ports);

}  // namespace hitpipe::sim
