// Section 8.2's proposal, measured: a small unit of n1 bits answers "hit", "miss" or "ask again with more
// bits", and a large unit of n2 bits is asked only then.
#pragma once

#include <string_view>

#include "sw_ref/thesis/experiment.hpp"

namespace hitpipe::sim {

/// A row for each built-in scene and figure, a column for each n1. options.only: names of built-in scenes.
[[nodiscard]] ref::ResultTable adaptive_precision(std::string_view number,
                                                  const ref::ExperimentOptions& options);

}  // namespace hitpipe::sim
