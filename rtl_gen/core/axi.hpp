// A core behind AXI (docs/core.md): the module MODULE_axi contains the core and its registers. Rays come and
// answers leave by AXI4-Stream, the host writes and reads registers by AXI4-Lite, and blocks are read by
// AXI4: one beat of 256 bits a request, in any order. A core with rings reads rays and writes answers by another AXI4.
#pragma once

#include <string>
#include <vector>

#include "rtl_gen/component/library.hpp"
#include "rtl_gen/core/core.hpp"
#include "rtl_gen/emit/axi_stream.hpp"

namespace hitpipe::rtl {

inline constexpr const char* axi_clock = "aclk";

[[nodiscard]] std::string axi_module(const Core& core);
/// Those that stand beside the core in the module.
[[nodiscard]] std::vector<MachineGraph> axi_machines(const Core& core);
/// What a ray and an answer say: fields of s_axis_ray_tdata and m_axis_hit_tdata, or of records in memory. The tag is
/// not one of them.
[[nodiscard]] std::vector<Port> ray_ports(const Core& core);
[[nodiscard]] std::vector<Port> hit_ports(const Core& core);
/// Where each of them is.
[[nodiscard]] std::vector<StreamField> ray_fields(const Core& core);
[[nodiscard]] std::vector<StreamField> hit_fields(const Core& core);
/// Of the whole.
[[nodiscard]] int ray_bytes(const Core& core);
[[nodiscard]] int hit_bytes(const Core& core);

/// The wrapper and its registers in Verilog-2001, without the core.
[[nodiscard]] std::string axi_verilog(const Core& core);
/// The object `axi` of the manifest: module, and the fields of rays and answers.
[[nodiscard]] Json axi_json(const Core& core);

}  // namespace hitpipe::rtl
