// A feed that changes or checks its operands before the unit sees them, and the steps that do so.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "rays/world/coarse_axes.hpp"
#include "rtl_gen/catalogue/port.hpp"
#include "sim/software/feed.hpp"

namespace hitpipe::sim {

/// Changes or checks operands in port order, sign-extended when signed. Many threads call it.
using OperandStep = std::function<void(std::int64_t* operands)>;

[[nodiscard]] std::unique_ptr<SceneFeed> with_step(std::unique_ptr<SceneFeed> feed, OperandStep step);

/// Changes origin and box as coarse_origin() and coarse_box() do; finds their ports by role. Throws
/// std::invalid_argument if the ports are not an integer unit's, or have fewer bits than are to be
/// dropped.
[[nodiscard]] OperandStep coarse_step(const std::vector<rtl::Port>& ports, const ref::CoarseAxes& coarse);

/// Tells the unit that no ray has an end, so no box ahead of the origin is too far away. Throws
/// std::invalid_argument when no port can say so.
[[nodiscard]] OperandStep endless_step(const std::vector<rtl::Port>& ports);

}  // namespace hitpipe::sim
