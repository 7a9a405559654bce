// An AXI4-Stream wrapper of a design: module <design>_axis around the emitted module, for block designs and
// DMA engines. A beat of s_axis is one test, its tid the tag; a beat of m_axis is one HIT. No input reaches
// an output without a register between: a spare result latch takes the one that m_axis_tready comes too late
// for. Latency and throughput stay those of the design.
#pragma once

#include <string>
#include <vector>

#include "rtl_gen/catalogue/design.hpp"

namespace hitpipe::rtl {

/// Where a port lies in s_axis_tdata: in port order from bit 0, each field on a byte boundary.
struct StreamField {
  std::string name;
  int offset;  ///< of its lowest bit
  int width;
};
[[nodiscard]] std::vector<StreamField> stream_fields(const std::vector<Port>& ports);
/// Of s_axis_tdata: a whole number of bytes.
[[nodiscard]] int stream_bits(const std::vector<Port>& ports);

/// "<design>_axis", the module's name.
[[nodiscard]] std::string stream_module(const Design& design);
/// Verilog-2001 of the wrapper; the design's own module is in a file of its own.
[[nodiscard]] std::string axi_stream(const Design& design, const std::vector<Port>& ports);

}  // namespace hitpipe::rtl
