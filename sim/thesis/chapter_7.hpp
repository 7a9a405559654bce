// Tables 7.1 and 7.2 as experiments: the component library, and the prices of the six units.
#pragma once

#include <span>
#include <string_view>

#include "sw_ref/thesis/experiment.hpp"

namespace hitpipe::sim {

/// All experiments of the thesis: ref::experiments() and chapter 7, in the thesis's order.
[[nodiscard]] std::span<const ref::Experiment> thesis_experiments();

/// Those experiments, and what section 8.2 proposes: "adaptive", "grid", "kd". The thesis prints no figures
/// of these.
[[nodiscard]] std::span<const ref::Experiment> experiments_and_proposals();

/// Section 8.2's proposal, measured: a small unit of n1 bits answers "hit", "miss" or "ask again with more
/// bits", and a large unit of n2 bits is asked only then. A row for each built-in scene and figure, a column
/// for each n1. options.only: names of built-in scenes.
[[nodiscard]] ref::ResultTable adaptive_precision(std::string_view number,
                                                  const ref::ExperimentOptions& options);

}  // namespace hitpipe::sim
