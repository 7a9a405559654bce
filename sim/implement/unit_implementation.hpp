// A unit in a target: written, synthesised, counted, placed or timed, its netlist simulated.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "rtl_gen/catalogue/design.hpp"
#include "rtl_gen/verilog/module_interface.hpp"
#include "sim/implement/module_implementation.hpp"
#include "sim/vectors/design_vectors.hpp"

namespace hitpipe::sim {

struct ImplementOptions {
  std::filesystem::path folder;
  std::string module{};             ///< empty: the design's own name
  std::string library{};            ///< empty: the target's
  std::optional<int> block_luts{};  ///< what a multiplier block is worth; nothing: as the library says
  std::optional<int> clock_ps{};
  int interval = 1;  ///< a test may begin every so many cycles
  /// Of the unit. A net that stops every register of a chip costs clock and cells.
  rtl::FlowControl flow_control = rtl::FlowControl::none;
  int seeds = 5;                  ///< of the placement; 0: the unit is not placed
  std::optional<int> simulate{};  ///< how many vectors go through the netlist
  Simulator simulator = Simulator::icarus;
  std::uint64_t seed = usual_seed;  ///< of the vectors
  StepListener progress = [](const std::string&) {};

  /// The component library that drives the schedule. Throws std::runtime_error, one line.
  [[nodiscard]] rtl::Library library_for(const Target& for_target) const;
};

/// Makes a folder in options.folder that is named after the target. Writes the unit to it as
/// rtl::write_unit() does, and all that the tools read and wrote. Throws std::runtime_error, one line, when a
/// tool is missing or fails. A unit that does not fit is a result.
[[nodiscard]] Implementation implement_unit(const rtl::Design& design, const Format& format,
                                            const Target& target, const ImplementOptions& options);

}  // namespace hitpipe::sim
