// Energy of a test in standard cells: the toggles of a simulated netlist, priced by OpenSTA with the cells'
// own Liberty file. It counts cells, and the clock inside registers. It leaves out wires, the clock's own
// tree, and glitches, because the netlist is simulated without delays and timed without wires.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "sim/implement/synthesis.hpp"

namespace hitpipe::sim {

struct NetActivity {
  double toggles = 0;  ///< a clock cycle
  double high = 0;     ///< share of the time, 0..1
};

/// What the nets of a netlist did in a simulation.
struct Activity {
  std::map<std::string, NetActivity> nets;  ///< by name; bit 3 of a vector is "name[3]"
  std::int64_t cycles = 0;
};

/// Reads the value changes of the module that a VCD file dumps, until its end. A bit that is unknown is 0.
/// Throws std::runtime_error, one line, when there is no net `clock` or it never rises.
[[nodiscard]] Activity read_activity(const std::string& vcd, const std::string& clock);

struct Energy {
  double pj_per_test = 0;
  double sequential_pct = 0;   ///< of it in registers
  double cycles_per_test = 0;  ///< of the simulation, which has gaps
};
/// Of `tests` tests. Throws std::runtime_error, one line, when OpenSTA fails.
[[nodiscard]] Energy energy_of(const Target& target, const Synthesis& netlist, const Activity& activity,
                               std::int64_t tests, const std::string& clock, const Tool& sta,
                               const Workbench& bench);

}  // namespace hitpipe::sim
