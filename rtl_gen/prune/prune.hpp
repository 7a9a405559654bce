// Simplifies the graph of a design under demands: runs the passes of passes.hpp in turn until none changes
// anything. The result is scheduled, emitted and priced like any traced graph. docs/prune.md tells what each
// pass may do.
#pragma once

#include "rtl_gen/prune/report.hpp"

namespace hitpipe::rtl {

struct PruneOptions {
  /// What the design's operands meet in any case: demands that say no more leave the graph as it is.
  Demands promised{};
  /// Without it the `demands` of cuts and `shares` stay empty, which saves one run for each demand.
  bool shares = true;
};

struct Pruned {
  Graph graph;
  PruneReport report;
};

/// The outputs are equal for all operands that meet the demands. Throws as check_demands() does.
[[nodiscard]] Pruned prune(const Graph& traced, const Demands& demands, const PruneOptions& options = {});

}  // namespace hitpipe::rtl
