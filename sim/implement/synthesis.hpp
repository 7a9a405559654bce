// A module mapped to the cells of a target by Yosys, and the counts of these cells.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "host/files.hpp"
#include "sim/implement/target.hpp"
#include "sim/implement/workbench.hpp"

namespace hitpipe::sim {

/// Of every module that is mapped, unless its bus has another.
inline constexpr const char* module_clock = "clk";

/// Verilog that goes into a chip: a unit, or a top of the user's own around it.
struct ChipSources {
  std::string top;
  std::vector<host::File> verilog;
  std::string clock = module_clock;
};

struct ResourceCount {
  std::string name;  ///< one of resource_names
  int used = 0;
  std::optional<int> available;

  [[nodiscard]] bool fits() const { return !available || used <= *available; }
  /// "4 of 8 dsps". The chip must say what it has.
  [[nodiscard]] std::string text() const;
};

struct Synthesis {
  std::string top;
  std::map<std::string, int> cells;   ///< how many of each kind
  std::vector<ResourceCount> counts;  ///< those that mapped cells decide
  std::optional<double> area_um2;     ///< of standard cells

  [[nodiscard]] int cell_count() const;
  /// The mapped module in the workbench, as Verilog and as JSON for Yosys and nextpnr.
  [[nodiscard]] std::string verilog() const { return top + "_netlist.v"; }
  [[nodiscard]] std::string json() const { return top + "_netlist.json"; }
};

/// Cells by kind in what Yosys's `stat -json` prints. Throws std::runtime_error, one line, when a cell is not
/// mapped, or the text is another.
[[nodiscard]] std::map<std::string, int> mapped_cells(const std::string& stat);
/// The area in what Yosys's `stat -liberty` prints.
[[nodiscard]] double cell_area(const std::string& stat);
[[nodiscard]] std::vector<ResourceCount> count_resources(const Target& target,
                                                         const std::map<std::string, int>& cells);

/// The target's lines for Yosys, with the names filled in.
[[nodiscard]] std::string synthesis_lines(const Target& target, const std::string& top);

/// Keeps script, log, counts and netlists, each beginning with the top's name. Throws std::runtime_error, one
/// line, when Yosys fails.
[[nodiscard]] Synthesis synthesise(const Target& target, const ChipSources& sources, const Tool& yosys,
                                   const Workbench& bench);

/// The slack that a run of the script printed, in ns. Throws std::runtime_error, one line, when there is
/// none.
[[nodiscard]] double slack_ns(const std::string& output);

/// Delay of the slowest path in ns: clock to output, logic, set-up. Keeps script and report, each beginning
/// with the top's name. Throws std::runtime_error, one line, when OpenSTA fails.
[[nodiscard]] double critical_path_ns(const Target& target, const Synthesis& netlist,
                                      const std::string& clock, const Tool& sta, const Workbench& bench);

}  // namespace hitpipe::sim
