// A design as files: Verilog, manifest, FuseSoC core, schematic, testbench and its vectors.
#pragma once

#include <string>
#include <vector>

#include "host/files.hpp"
#include "rtl_gen/catalogue/design.hpp"
#include "rtl_gen/component/library.hpp"
#include "rtl_gen/pipeline.hpp"
#include "rtl_gen/prune/report.hpp"

namespace hitpipe::rtl {

using host::File;

/// What a pipeline that is not the whole design's was made of.
struct PrunedFrom {
  const std::vector<Port>& ports;  ///< the whole design's
  const Demands& demands;          ///< not empty
  const PruneReport& report;
};

struct EmitOptions {
  bool axi_stream = false;  ///< also <design>_axis.v; core and manifest speak of it
  /// Of a fitted unit: also <design>_check.v, a module that checks operands as they come from the set-up; a
  /// check block in the Verilog, the demands in the manifest, and vectors as demanded.
  const PrunedFrom* pruned_from = nullptr;
};

/// <design>.v, .json, .core, .dot, a .dot for each group of stages, and in tb/ <design>_tb.v and
/// _vectors.hex; the same bytes for the same design, format and library. `pipeline` is the design's at that
/// format, or what pruning left of it.
[[nodiscard]] std::vector<File> emit(const Design& design, Format format, const Library& library,
                                     const Pipeline& pipeline, const EmitOptions& options = {});

/// An .svg for each .dot among the files, drawn by Graphviz's dot. Throws std::runtime_error when dot is
/// missing or fails.
[[nodiscard]] std::vector<File> draw(const std::vector<File>& files);

}  // namespace hitpipe::rtl
