// An AXI4-Stream wrapper for block designs and DMA engines: the module <module>_axis contains the emitted
// module. A beat of s_axis is one test, and its tid is the tag. A beat of m_axis holds the results of one.
// There is a register on every path from input to output. In front of a unit that stalls, a spare latch holds
// the result that has already left the pipeline when m_axis_tready falls. A unit without flow control is
// behind its result FIFO. Latency and throughput stay as they are without the wrapper.
#pragma once

#include <string>
#include <vector>

#include "rtl_gen/emit/manifest.hpp"
#include "rtl_gen/verilog/module_interface.hpp"

namespace hitpipe::rtl {

/// Where a port lies in tdata: in port order from bit 0, each field on a byte boundary. The bits above a
/// field are ignored in s_axis_tdata, and 0 in m_axis_tdata.
struct StreamField {
  std::string name;
  int offset;  ///< position of its lowest bit
  int width;
};
[[nodiscard]] std::vector<StreamField> stream_fields(const std::vector<Port>& ports);
/// The width of tdata, a whole number of bytes.
[[nodiscard]] int stream_bits(const std::vector<Port>& ports);

/// What a wrapper's text has for each field of a beat.
struct BeatText {
  /// `word` is the name of the beat.
  BeatText(const std::vector<StreamField>& fields, const std::string& word);
  BeatText(const std::vector<Port>& ports, const std::string& word) : BeatText(stream_fields(ports), word) {}

  std::string layout;                ///< a comment line for each
  std::vector<std::string> bits;     ///< "word[high:low]"
  std::vector<std::string> padding;  ///< the bits above each field that has any
};

/// The name of the wrapper of a unit's module.
[[nodiscard]] std::string stream_module(const std::string& module);
/// aclk, aresetn, s_axis and m_axis.
[[nodiscard]] ModuleInterface stream_interface(const ModuleInterface& unit);
/// The wrapper in Verilog-2001, without the modules that it contains: the unit, and its result FIFO if it has no
/// flow control. Throws as check_names() does.
[[nodiscard]] std::string axi_stream(const ModuleInterface& unit);
/// The object axi_stream of a manifest: module, file, clock, reset, and the fields of tdata and tid.
[[nodiscard]] Json stream_json(const ModuleInterface& unit);

}  // namespace hitpipe::rtl
