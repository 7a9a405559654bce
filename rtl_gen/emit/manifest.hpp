// The manifest of an emitted design: what a flow needs to know, in JSON. It is computed from the graph that
// was emitted.
#pragma once

#include <string>
#include <vector>

#include "rtl_gen/catalogue/design.hpp"
#include "rtl_gen/pipeline.hpp"
#include "rtl_gen/verilog/flow_control.hpp"

namespace hitpipe::rtl {

/// Keys: design, kind, bits, module, verilog, clock, reset, flow_control, handshake, ports (name, direction,
/// width, signed), results (name, meaning, box, width), stages, latency, clock_ps, library, by_stage (for
/// each stage, its components with their counts and the latch bits at its end). With `stream` also
/// axi_stream: the wrapper's module, file, clock, reset, and the fields of its tdata and tid.
[[nodiscard]] std::string manifest(const Design& design, Format format, const std::string& module,
                                   const Pipeline& pipeline, const Library& library, bool stream = false,
                                   FlowControl flow = FlowControl::stall);

/// The manifest with the key `files`: all files of the unit.
[[nodiscard]] std::string with_files(const std::string& manifest, const std::vector<std::string>& files);

/// What a manifest says about its unit.
struct ManifestHead {
  std::string design;
  std::string bits;
  std::string module;  ///< its Verilog is in MODULE.v
  int latency = 0;
  FlowControl flow_control = FlowControl::stall;
  std::vector<std::string> files{};  ///< none in a manifest that does not list them
};

/// Throws std::runtime_error, one line, when the text is not a manifest.
[[nodiscard]] ManifestHead head_of(const std::string& manifest);

}  // namespace hitpipe::rtl
