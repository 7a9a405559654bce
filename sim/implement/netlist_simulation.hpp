// A mapped netlist runs the testbench that hitpipe writes for the unit, with the simulation models of its
// cells.
#pragma once

#include <string>

#include "host/files.hpp"
#include "sim/implement/synthesis.hpp"

namespace hitpipe::sim {

enum class Simulator { icarus, verilator };

/// The programs that a simulation runs.
struct SimulatorTools {
  Simulator simulator;
  Tool compiler;  ///< iverilog or verilator
  Tool runner;    ///< vvp; of Verilator none
};
/// Throws as find_tool() does.
[[nodiscard]] SimulatorTools find_simulator(Simulator simulator);

/// Throws std::runtime_error, one line, when the target has no simulation models.
void check_models(const Target& target);

struct NetlistTestbench {
  host::File testbench;  ///< as the unit has it; its vectors are read from the folder that it runs in
  host::File vectors;
  bool dumps = false;  ///< Icarus writes waves_file(): the nets of the netlist, not what is inside its cells
};
/// "int_slabs.vcd"
[[nodiscard]] std::string waves_file(const Synthesis& netlist);

struct NetlistAnswer {
  bool agrees = false;
  std::string said;  ///< the testbench's last word: "PASS 1000 vectors" or "FAIL ..."
};

/// Runs all vectors. `yosys` converts the Liberty file for Verilator, which does not take the primitives of
/// the cells' own Verilog. Keeps logs. Throws as check_models() does, and std::runtime_error, one line, when
/// a tool fails in another way than by a wrong result.
[[nodiscard]] NetlistAnswer simulate_netlist(const Target& target, const Synthesis& netlist,
                                             const NetlistTestbench& testbench, const SimulatorTools& tools,
                                             const Tool& yosys, const Workbench& bench);

/// The line that begins with PASS or FAIL.
[[nodiscard]] std::string last_word(const std::string& output);

}  // namespace hitpipe::sim
