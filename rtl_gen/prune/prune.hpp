// A design takes demands and its graph simplifies itself: the passes of passes.hpp in turn until none changes
// anything. The result is a traced graph like any other: it is scheduled, emitted and priced by the same
// rules. docs/prune.md tells what each pass may do.
#pragma once

#include "rtl_gen/prune/report.hpp"

namespace hitpipe::rtl {

struct PruneOptions {
  /// The interface stays as it is: unread ports and bits are left unread. Then the unit can check all its
  /// operands itself (check_block.hpp).
  bool keep_ports = false;
  /// What holds of the design's operands anyway: demands that say no more leave the graph as it is.
  Demands promised{};
  /// Without, `demands` of cuts and `shares` stay empty: each demand takes another run.
  bool shares = true;
};

struct Pruned {
  Graph graph;
  PruneReport report;
};

/// Equal outputs for all operands that meet the demands. Throws as check_demands() does.
[[nodiscard]] Pruned prune(const Graph& traced, const Demands& demands, const PruneOptions& options = {});

}  // namespace hitpipe::rtl
