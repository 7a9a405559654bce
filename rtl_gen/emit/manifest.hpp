// The manifest of an emitted part: what a flow needs to know, in JSON. It is computed from the graph that
// was emitted, and stays one JSON value until its file is written.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "rtl_gen/part/part.hpp"
#include "rtl_gen/prune/report.hpp"
#include "rtl_gen/verilog/module_interface.hpp"

namespace hitpipe::rtl {

using Json = nlohmann::ordered_json;

/// Keys of all: design or machine, bits, module, license, verilog, clock, reset, ports (name, direction, width,
/// signed), clock_ps, library. A unit also has kind, flow_control, handshake, parameters, results (name, meaning,
/// box, width), stages, latency and by_stage (for each stage, its components with their counts and the latch
/// bits at its end); one that takes a test every N cycles, N > 1, has `ii`, which is N, and `shared` (its shared
/// components, which are in no stage). A machine has longest_path, registers (name, width, signed, reset) and
/// memories (name, words, width, kind). Wrappers add an object each, and emit() adds `files`.
[[nodiscard]] Json manifest(const Part& part, const Library& library);

/// Of any module: bits, module, license, verilog, clock, reset.
[[nodiscard]] Json module_json(const Format& format, const ModuleInterface& interface);
[[nodiscard]] Json memories_json(const MachineGraph& machine);

/// The pins of a module, in the order of its Verilog: name, direction, width, signed.
[[nodiscard]] Json ports_json(const ModuleInterface& interface);

/// Adds what software must know of a fitted unit: `demands` (port, within and low_zeros if any, or lesser and
/// greater), which it must check, `dropped_ports`, `narrowed_ports` (name, from, to bits) and `left_out` (a
/// line for each cut). Without demands the manifest does not change.
void add_demands(Json& manifest, const Demands& demands, const PruneReport& report);

/// What a manifest says about its unit.
struct ManifestHead {
  std::string design;
  std::string bits;
  std::string module;  ///< its Verilog is in MODULE.v
  int latency = 0;
  FlowControl flow_control = FlowControl::stall;
  int interval = 1;
  std::vector<std::string> files{};  ///< none in a manifest that does not list them
};

/// Throws std::runtime_error, one line, when the text is not a manifest.
[[nodiscard]] ManifestHead head_of(const std::string& manifest);

/// The demands of a manifest; none when it has no field `demands`. Throws std::runtime_error, one line, when
/// the field is not as add_demands() writes it.
[[nodiscard]] Demands demands_of_manifest(const std::string& manifest);

}  // namespace hitpipe::rtl
