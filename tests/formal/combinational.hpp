// A datapath as Verilog without a clock: the traced graph before it is scheduled, with whole products and
// with float operators as combinational modules. The pipelined Verilog is proved equal to it
// (docs/formal.md).
#pragma once

#include <string>

#include "rtl_gen/graph/graph.hpp"

namespace hitpipe::rtl {

/// The module `name`, whose ports are the graph's inputs and outputs, and one module for each unit that it
/// calls, named NAME_BODY after `name` and the unit's body. The graph is taken as it was traced.
[[nodiscard]] std::string to_combinational_verilog(const Graph& traced, const std::string& name);

}  // namespace hitpipe::rtl
