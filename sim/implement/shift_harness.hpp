// A unit has more operand bits than a package has pins. For placement it stands between two shift registers
// with a clock of their own. So every path in the unit's clock begins and ends in the unit's registers.
#pragma once

#include <string>
#include <vector>

namespace hitpipe::sim {

struct ChipPort {
  std::string name;
  int width = 0;
  bool is_input = false;
};

/// The ports of a module, in the netlist that Yosys's write_json wrote. Throws std::runtime_error, one line,
/// when the module is not there.
[[nodiscard]] std::vector<ChipPort> ports_of_netlist(const std::string& json, const std::string& module);

/// Of the module that shift_harness() writes.
[[nodiscard]] std::string harness_module(const std::string& unit);

/// Verilog of a module that holds the unit as `unit`. Its pins are the unit's clock, shift_clk, shift_in,
/// shift_load and shift_out.
[[nodiscard]] std::string shift_harness(const std::string& unit, const std::string& clock,
                                        const std::vector<ChipPort>& ports);

}  // namespace hitpipe::sim
