// A pipeline as Verilog-2001. Registers are exactly where the schedule has them, names and source lines come
// from the C++, and the same graph gives the same bytes.
#pragma once

#include <string>
#include <vector>

#include "rtl_gen/pipeline.hpp"
#include "rtl_gen/verilog/module_interface.hpp"

namespace hitpipe::rtl {

struct VerilogOptions {
  std::string module_name;  ///< empty: the graph's name
  std::string bits;         ///< for the header comment, e.g. "20/24"
  FlowControl flow_control = FlowControl::stall;
  /// What the design says of its ports. A port that is in neither list is declared as the graph has it.
  std::vector<Port> operands{};
  std::vector<hls::Result> results{};
};

/// The top module, then one module for each kind of pipelined component in it. Beside operands and results
/// the top module has these ports:
///   clk, rst              one clock; a synchronous reset, active high, of the valid bits only
///   in_valid, in_ready    operands are taken at a rising edge with both high
///   in_tag, out_tag       TAG_BITS bits that travel with the operands
///   out_valid, out_ready  a result is handed over at a rising edge with both high, and held until then
/// in_ready falls only while a valid result waits for out_ready. The whole pipeline then stands still.
/// With FlowControl::none there is no in_ready and no out_ready, and no register has an enable: what is valid
/// at an edge comes out `latency` edges later, for one cycle.
/// With an interval of N cycles in_ready, which is then always there, is high in one of N cycles in which the
/// pipeline moves. A counter of the phase, 0 to N - 1, tells the shared components whose operands they get.
[[nodiscard]] std::string to_verilog(const Pipeline& pipeline, const Library& library,
                                     const VerilogOptions& options = {});

}  // namespace hitpipe::rtl
