// A feed that changes or checks its operands before the unit sees them.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "sim/feed.hpp"

namespace hitpipe::sim {

/// Changes or checks operands in port order. Many threads call it.
using OperandStep = std::function<void(std::int64_t* operands)>;

[[nodiscard]] std::unique_ptr<SceneFeed> with_step(std::unique_ptr<SceneFeed> feed, OperandStep step);

}  // namespace hitpipe::sim
