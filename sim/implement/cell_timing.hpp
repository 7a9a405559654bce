// The critical path of standard cells, by OpenSTA: from register to register, with an ideal clock and wires
// without load.
#pragma once

#include <string>

#include "sim/implement/synthesis.hpp"

namespace hitpipe::sim {

/// The slack that a run of the script printed, in ns. Throws std::runtime_error, one line, when there is
/// none.
[[nodiscard]] double slack_ns(const std::string& output);

/// Delay of the slowest path in ns: clock to output, logic, set-up. Keeps script and report, each beginning
/// with the top's name. Throws std::runtime_error, one line, when OpenSTA fails.
[[nodiscard]] double critical_path_ns(const Target& target, const Synthesis& netlist,
                                      const std::string& clock, const Tool& sta, const Workbench& bench);

}  // namespace hitpipe::sim
