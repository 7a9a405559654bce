// Tables 7.1 and 7.2 as experiments: the component library, and the prices of the six units.
#pragma once

#include <span>

#include "sw_ref/thesis/experiment.hpp"

namespace hitpipe::sim {

/// All experiments of the thesis: those of ref::experiments() and of chapter 7, in the thesis's order.
[[nodiscard]] std::span<const ref::Experiment> thesis_experiments();

/// Those experiments, and what section 8.2 proposes: "adaptive", "grid", "kd". The thesis prints no figures
/// of these.
[[nodiscard]] std::span<const ref::Experiment> experiments_and_proposals();

}  // namespace hitpipe::sim
