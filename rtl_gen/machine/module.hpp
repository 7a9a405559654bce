// A machine as Verilog-2001: registers and memories, and the graph of its step between them.
#pragma once

#include <string>

#include "rtl_gen/component/library.hpp"
#include "rtl_gen/machine/machine.hpp"
#include "rtl_gen/verilog/module_interface.hpp"

namespace hitpipe::rtl {

/// clk, rst (synchronous, active high), the inputs, the outputs.
[[nodiscard]] ModuleInterface machine_interface(const std::string& module, const MachineGraph& machine);

/// The longest path of a machine from one register to the next, through a lookup memory too.
struct MachinePath {
  int clock_ps = 0;                ///< with the register at its end: the shortest clock
  std::vector<std::string> names;  ///< of the values on it, from the first register to what it ends in
};
/// Throws std::runtime_error, one line, when the step has a component with stages inside.
[[nodiscard]] MachinePath longest_path(const MachineGraph& machine, const Library& library);

struct MachineModule {
  std::string module;  ///< its name
  std::string bits{};  ///< for the header comment: "20+1s20i5"
  /// Makes each register of the state an output too, state_REGISTER, behind the others. For tests.
  bool shows_state = false;
};
/// The same graph gives the same bytes.
[[nodiscard]] std::string to_verilog(const MachineGraph& machine, const MachineModule& options);

}  // namespace hitpipe::rtl
