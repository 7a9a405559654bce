// A machine as Verilog-2001: registers and memories, and the graph of its step between them.
#pragma once

#include <set>
#include <string>
#include <vector>

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
[[nodiscard]] MachinePath longest_path(const MachineGraph& machine, const Library& library);

struct MachineModule {
  std::string module;  ///< its name
  std::string bits{};  ///< for the header comment: "20+1s20i5"
  /// Makes each register of the state an output too, state_REGISTER, behind the others. For tests.
  bool shows_state = false;
  /// Memories that are marked for block RAMs. A word of theirs that is read while it is written may then be
  /// any word, so the machine must not use it.
  std::set<std::string> in_block_rams{};
};
/// The same graph gives the same bytes.
[[nodiscard]] std::string to_verilog(const MachineGraph& machine, const MachineModule& options);

}  // namespace hitpipe::rtl
