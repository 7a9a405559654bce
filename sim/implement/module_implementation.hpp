// A module in a target: synthesised, counted, placed or timed. What writes the module is apart: a unit
// (unit_implementation.hpp), a core (core_implementation.hpp), a board's top (board_implementation.hpp).
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/implement/energy.hpp"
#include "sim/implement/netlist_simulation.hpp"
#include "sim/implement/place_and_route.hpp"
#include "sim/implement/synthesis.hpp"
#include "sim/implement/target.hpp"

namespace hitpipe::sim {

/// Told what is being done.
using StepListener = std::function<void(const std::string& step)>;

struct Implementation {
  std::string module;
  std::string clock;  ///< its port
  Synthesis synthesis;
  std::vector<ResourceCount> counts;  ///< of the module alone, in the order of the target
  std::optional<PlacedDesign>
      placed{};  ///< nothing when the target is not placed, or the module does not fit
  std::optional<double> critical_path_ns{};  ///< of standard cells, or of the median seed
  std::vector<std::string> tools;            ///< versions
  std::string not_placed{};                  ///< why no placer has seen it
  std::string library{};                     ///< that drives the schedule
  int latency = 0;                           ///< of a unit
  std::optional<NetlistAnswer> simulated{};
  std::optional<Energy> energy{};  ///< of standard cells that Icarus has simulated
  /// What area_model/energy.hpp estimates for the same tests of a unit, in as many cycles.
  std::optional<double> estimated_pj_per_test{};
  bool drawn = true;  ///< false: Graphviz is not installed

  [[nodiscard]] const ResourceCount* count_of(std::string_view resource) const;
  /// What is used beyond what the chip has: "12 of 8 dsps"; empty when the module fits.
  [[nodiscard]] std::string excess() const;
  [[nodiscard]] std::optional<double> fmax_mhz() const;
};

/// Synthesises a module, packs it where the target is placed, and counts. Throws std::runtime_error, one
/// line, when a tool fails. A module that does not fit is a result.
[[nodiscard]] Implementation map_module(const Target& target, const ChipSources& sources,
                                        const ChipTools& tools, const Workbench& bench,
                                        const StepListener& progress);

/// Places a mapped module that fits between shift registers, with seeds 1 to `seeds`, or times its cells, as
/// the target says. Throws as map_module() does.
void place_or_time(Implementation& module, const Target& target, const ChipTools& tools,
                   const Workbench& bench, int seeds, const StepListener& progress);

}  // namespace hitpipe::sim
