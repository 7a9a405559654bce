// A design as files: Verilog, manifest, FuseSoC core, schematics, testbench and its vectors.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/files.hpp"
#include "rtl_gen/emit/manifest.hpp"
#include "rtl_gen/emit/unit.hpp"
#include "rtl_gen/emit/vectors.hpp"

namespace hitpipe::rtl {

using host::File;

struct EmitOptions {
  bool axi_stream = false;  ///< adds the AXI4-Stream wrapper; core and manifest name it
  bool fifo = false;        ///< adds the result FIFO, only with FlowControl::none; core and manifest name it
  bool hls = false;         ///< adds the top function for high-level synthesis
  /// Vectors for the testbench, of all ports of the whole design. Null: 1000 that are drawn at the ports.
  const VectorSet* vectors = nullptr;
};

/// The files of a design, each by what it is.
struct EmittedDesign {
  std::string module;                  ///< the unit's; it begins the name of every other module and file
  File verilog;                        ///< <module>.v
  File core;                           ///< <module>.core, for FuseSoC
  File testbench;                      ///< tb/<module>_tb.sv
  std::vector<File> more_testbenches;  ///< tb/<module>_fifo_tb.sv and so on, for each wrapper
  File harness;                        ///< tb/<module>_harness.cpp
  File makefile;                       ///< tb/Makefile, the same for all
  File vectors;                        ///< tb/<module>_vectors.hex
  std::optional<File> check_module;    ///< <module>_check.v, of a fitted unit
  std::optional<File> fifo;            ///< <module>_fifo.v, if asked for or needed by the AXI4-Stream wrapper
  std::optional<File> axi_stream;      ///< <module>_axis.v, if asked for
  std::vector<File> schematics{};      ///< a .dot for each group of stages, from the first on
  std::vector<File> hls{};             ///< hls/: the top function and its script, if asked for
  std::shared_ptr<const Json> manifest;  ///< without the list of files

  /// All of them and these drawings. <module>.json is the second; it lists all.
  [[nodiscard]] std::vector<File> files(const std::vector<File>& drawings = {}) const;
};

/// The same bytes for the same unit. Of a fitted unit it adds the check module and the demands in the
/// manifest, and the vectors meet the demands. A wrapper of a unit without flow control contains the result
/// FIFO. Throws as hls_top() and result_fifo() do, and std::invalid_argument, one line, for
/// options that do not go together.
[[nodiscard]] EmittedDesign emit(const Unit& unit, const EmitOptions& options = {});

/// An .svg for each .dot, drawn by Graphviz's dot; nothing when dot is not installed. Throws
/// std::runtime_error when dot fails.
[[nodiscard]] std::optional<std::vector<File>> draw(const std::vector<File>& schematics);
/// Adds what draw() makes of each .dot among the files.
void add_drawings(std::vector<File>& files);

}  // namespace hitpipe::rtl
