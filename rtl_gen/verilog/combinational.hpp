// A datapath as Verilog without a clock: the traced graph before it is scheduled, products whole, float
// operators as combinational modules. What the pipelined Verilog is proved equal to (docs/formal.md).
#pragma once

#include <string>

#include "rtl_gen/graph/graph.hpp"

namespace hitpipe::rtl {

/// The module `name` with the graph's inputs and outputs as its ports, and one module for each kind of unit
/// it calls, `name` and the unit's body's name joined by '_'. The graph is taken as it was traced.
[[nodiscard]] std::string to_combinational_verilog(const Graph& traced, const std::string& name);

}  // namespace hitpipe::rtl
