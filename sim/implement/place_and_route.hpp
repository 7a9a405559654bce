// Placing and routing with the target's nextpnr, with several seeds, and what its reports say.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sim/implement/synthesis.hpp"

namespace hitpipe::sim {

/// A path from register to register that decides the clock.
struct CriticalPath {
  double logic_ns = 0;    ///< clock to output, logic, set-up
  double routing_ns = 0;  ///< wires
  std::string from, to;   ///< cells

  [[nodiscard]] double delay_ns() const { return logic_ns + routing_ns; }
};

struct PlacedSeed {
  int seed = 0;
  double fmax_mhz = 0;
  CriticalPath critical;
};

struct PlacedDesign {
  std::vector<PlacedSeed> seeds;
  std::string why_not{};  ///< what nextpnr said when it could not place or route the design; then no seeds

  /// With the highest frequency. There are seeds.
  [[nodiscard]] PlacedSeed best() const;
  /// In the middle; of an even number of seeds the slower one. There are seeds.
  [[nodiscard]] PlacedSeed median() const;
};

struct PlaceRequest {
  std::string top;      ///< its netlist is TOP_netlist.json or what `netlist` names
  std::string netlist;  ///< JSON in the workbench
  std::string clock;    ///< of the top; its frequency is reported
  /// Its pins are used, and each seed leaves a file for its packer. Without a board pins are as nextpnr
  /// likes.
  const rtl::Board* board = nullptr;
  int seeds = 1;
  /// Told before each seed.
  std::function<void(int seed)> progress = [](int) {};
};

/// What a report in JSON says of the clock. nextpnr puts words between dollar signs around the clock's name,
/// as in "clk$SB_IO_IN_$glb_clk" and "$glbnet$clk". Throws std::runtime_error, one line, when it says nothing
/// of it.
[[nodiscard]] PlacedSeed read_report(const std::string& json, const std::string& clock);
/// The resources in "Device utilisation" of a log.
[[nodiscard]] int packed_count(const std::string& log, const std::string& resource);

/// Packs a netlist and counts what the target counts in that way.
[[nodiscard]] std::vector<ResourceCount> pack(const Target& target, const Synthesis& netlist,
                                              const Tool& placer, const Workbench& bench);

/// Keeps a log and a report for each seed. A design that does not go in is a result; throws
/// std::runtime_error, one line, when nextpnr fails otherwise.
[[nodiscard]] PlacedDesign place_and_route(const Target& target, const PlaceRequest& request,
                                           const Tool& placer, const Workbench& bench);

}  // namespace hitpipe::sim
