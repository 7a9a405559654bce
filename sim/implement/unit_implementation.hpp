// A unit in a target: written, synthesised, counted, placed or timed, its netlist simulated.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "rtl_gen/catalogue/design.hpp"
#include "rtl_gen/verilog/module_interface.hpp"
#include "sim/implement/energy.hpp"
#include "sim/implement/netlist_simulation.hpp"
#include "sim/implement/place_and_route.hpp"
#include "sim/implement/target.hpp"
#include "sim/vectors/design_vectors.hpp"

namespace hitpipe::sim {

struct ImplementOptions {
  std::filesystem::path folder;
  std::string module{};   ///< empty: the design's own name
  std::string library{};  ///< empty: the target's
  std::optional<int> clock_ps{};
  int interval = 1;  ///< a test may begin every so many cycles
  /// Of the unit. A net that stops every register of a chip costs clock and cells.
  rtl::FlowControl flow_control = rtl::FlowControl::none;
  int seeds = 5;                  ///< of the placement; 0: the unit is not placed
  std::optional<int> simulate{};  ///< how many vectors go through the netlist
  Simulator simulator = Simulator::icarus;
  std::uint64_t seed = usual_seed;  ///< of the vectors
  /// Told what is being done.
  std::function<void(const std::string& step)> progress = [](const std::string&) {};
};

struct Implementation {
  std::string module;
  std::string library;
  int latency = 0;
  Synthesis synthesis;
  std::vector<ResourceCount> counts;     ///< of the unit alone, in the order of the target
  std::optional<PlacedDesign> placed{};  ///< nothing when the target is not placed, or the unit does not fit
  std::optional<double> critical_path_ns{};  ///< of standard cells, or of the median seed
  std::optional<NetlistAnswer> simulated{};
  std::optional<Energy> energy{};  ///< of standard cells that Icarus has simulated
  std::vector<std::string> tools;  ///< versions
  bool drawn = true;               ///< false: Graphviz is not installed

  [[nodiscard]] const ResourceCount* count_of(std::string_view resource) const;
  /// What is used beyond what the chip has: "12 of 8 dsps"; empty when the unit fits.
  [[nodiscard]] std::string excess() const;
  [[nodiscard]] std::optional<double> fmax_mhz() const;
};

/// Makes a folder in options.folder that is named after the target. Writes the unit to it as
/// rtl::write_unit() does, and all that the tools read and wrote. Throws std::runtime_error, one line, when a
/// tool is missing or fails. A unit that does not fit is a result.
[[nodiscard]] Implementation implement_unit(const rtl::Design& design, const rtl::Format& format,
                                            const Target& target, const ImplementOptions& options);

}  // namespace hitpipe::sim
