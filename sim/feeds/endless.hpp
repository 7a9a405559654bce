// Operands of a unit that does not know where a ray ends: no box ahead of the origin is too far away.
#pragma once

#include <vector>

#include "rtl_gen/catalogue/port.hpp"
#include "sim/feeds/with_step.hpp"

namespace hitpipe::sim {

/// Tells the unit that no ray has an end, so the unit ignores length or endpoint. Throws
/// std::invalid_argument when no port can say so.
[[nodiscard]] OperandStep endless_step(const std::vector<rtl::Port>& ports);

}  // namespace hitpipe::sim
