// Verilog that watches whether the operands a fitted unit accepts are as demanded: plain Verilog-2001.
#pragma once

#include <string>
#include <vector>

#include "rtl_gen/prune/demands.hpp"

namespace hitpipe::rtl {

/// To stand in a module with these ports and clk, rst, in_valid, in_ready, where HITPIPE_CHECK is defined
/// and SYNTHESIS is not: ends the simulation, naming demand and operand, when an accepted operand breaks a
/// demand. `original` are the design's ports before pruning. Demands on ports that are gone, or too narrow to
/// tell, are named in a comment: prune with keep_ports, or check_module(), to have all. Empty when there are
/// no demands.
[[nodiscard]] std::string check_block(const std::string& module, const Demands& demands,
                                      const std::vector<Port>& original, const std::vector<Port>& ports);

/// `verilog` with the block at the end of its first module.
[[nodiscard]] std::string with_check_block(const std::string& verilog, const std::string& block);

/// A module `name` of its own, without a clock, for the operands as they come from outside: every port that a
/// demand speaks of, and `error`, 1 when a demand is broken.
[[nodiscard]] std::string check_module(const std::string& name, const Demands& demands,
                                       const std::vector<Port>& original);

}  // namespace hitpipe::rtl
