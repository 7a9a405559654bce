// Verilog-2001 of a pipeline: registers exactly where the schedule has them, names and source lines from the
// C++, the same bytes for the same graph.
#pragma once

#include <string>

#include "rtl_gen/pipeline.hpp"

namespace hitpipe::rtl {

/// The ports beside a design's operands and results.
///   clk, rst            one clock; synchronous reset, active high, of the valid bits only
///   in_valid, in_ready  operands are taken at a rising edge with both high
///   in_tag, out_tag     TAG_BITS that travel with the operands
///   out_valid, out_ready  a result is handed over at a rising edge with both high; held while out_ready is
///   low
/// in_ready falls only when a valid result waits for out_ready: then the whole pipeline stands still.
struct VerilogOptions {
  std::string module_name;  ///< empty: the graph's name
  std::string bits;         ///< for the header comment, e.g. "20/24"
};

/// The top module first, then one module for each kind of pipelined component it has.
[[nodiscard]] std::string to_verilog(const Pipeline& pipeline, const Library& library,
                                     const VerilogOptions& options = {});

}  // namespace hitpipe::rtl
