// A design as files: Verilog, manifest, FuseSoC core, schematic, testbench and its vectors.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "rtl_gen/catalogue/design.hpp"
#include "rtl_gen/component/library.hpp"
#include "rtl_gen/pipeline.hpp"
#include "rtl_gen/prune/report.hpp"

namespace hitpipe::rtl {

struct File {
  std::string name;
  std::string contents;
};

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

/// Makes the folder unless it is there. Throws std::runtime_error naming it and the reason when it cannot be
/// made or written to.
void make_folder(const std::filesystem::path& folder);

/// Writes all files or none: each to a temporary name first, then renamed. Makes the folders.
/// Throws std::runtime_error naming the file and the reason.
void write_files(const std::filesystem::path& folder, const std::vector<File>& files);

}  // namespace hitpipe::rtl
