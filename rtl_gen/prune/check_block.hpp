// Verilog-2001 that checks whether the operands of a fitted unit meet its demands.
#pragma once

#include <string>
#include <vector>

#include "rtl_gen/prune/demands.hpp"
#include "rtl_gen/verilog/module_interface.hpp"

namespace hitpipe::rtl {

/// A block for the module of a unit. It is active when HITPIPE_CHECK is defined and SYNTHESIS is not. When an
/// accepted operand breaks a demand it prints demand and operand and ends the simulation with $fatal.
/// `original` are the ports of the design before pruning. A comment names the demands on ports that are gone
/// or too narrow to tell; check_module() checks those too. Empty without demands.
[[nodiscard]] std::string check_block(const ModuleInterface& unit, const Demands& demands,
                                      const std::vector<Port>& original);

/// Puts the block at the end of the first module of `verilog`.
[[nodiscard]] std::string with_check_block(const std::string& verilog, const std::string& block);

/// A module without a clock that checks the operands before they reach the unit. Its inputs are the original
/// ports that have demands; its output `error` is 1 when a demand is broken.
[[nodiscard]] std::string check_module(const std::string& name, const Demands& demands,
                                       const std::vector<Port>& original);

}  // namespace hitpipe::rtl
