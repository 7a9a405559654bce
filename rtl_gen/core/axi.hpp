// A core behind AXI (docs/core.md): the module MODULE_axi has the core, its registers and what its bus needs. The host
// writes and reads registers by AXI4-Lite, and the core reads blocks by AXI4. Rays come and answers leave by
// AXI4-Stream, unless a feature has another way.
#pragma once

#include <string>
#include <vector>

#include "rtl_gen/core/core.hpp"
#include "rtl_gen/emit/axi_stream.hpp"
#include "rtl_gen/part/assembly.hpp"

namespace hitpipe::rtl {

inline constexpr const char* axi_clock = "aclk";

/// What a ray or an answer says outside, and where each of it lies. The tag is not one of the fields.
struct CoreRecord {
  std::vector<Port> ports;
  std::vector<StreamField> fields;  ///< of the same
  int bytes;
  std::string word;   ///< for readers of the Verilog: "s_axis_ray_tdata"
  std::string place;  ///< for readers of the C header: "beat of s_axis_ray"
};
struct CoreRecords {
  CoreRecord ray, hit;
  std::string way;  ///< "AXI4-Stream"
};
[[nodiscard]] CoreRecords records_of(const Core& core);
/// Ports of the core whose names begin so, without that, but for valid, ready and tag.
[[nodiscard]] std::vector<Port> ports_of(const Core& core, std::string_view before);

[[nodiscard]] std::string axi_module(const Core& core);
/// The core, its registers, and what joins them. Throws std::logic_error if something is not joined.
[[nodiscard]] Assembly behind_axi(const Core& core);
/// The wrapper and its machines in Verilog-2001, without the core.
[[nodiscard]] std::string axi_verilog(const Core& core);
/// The object `axi` of the manifest: module, and the fields of rays and answers.
[[nodiscard]] Json axi_json(const Core& core);

}  // namespace hitpipe::rtl
