// The part of a core's AXI wrapper (axi.hpp) that reads rays from a ring in memory and writes answers to another: a
// port of AXI4 of its own, of 64 or 128 bits, without identifiers (hls/machines/rings.hpp).
#pragma once

#include <map>
#include <string>
#include <vector>

#include "rtl_gen/core/core.hpp"
#include "rtl_gen/emit/axi_stream.hpp"

namespace hitpipe::rtl {

inline constexpr int ring_ray_bytes = 32, ring_hit_bytes = 16;
inline constexpr int ring_tag_bytes = 3;
inline constexpr int ring_ray_tag_at = 28, ring_hit_tag_at = 4;  ///< bytes of the tag's first byte

/// What a ray and an answer say, and where in memory; the tag apart.
[[nodiscard]] std::vector<Port> ring_ray_ports(const Core& core);
[[nodiscard]] std::vector<Port> ring_hit_ports(const Core& core);
[[nodiscard]] std::vector<StreamField> ring_ray_fields(const Core& core);
[[nodiscard]] std::vector<StreamField> ring_hit_fields(const Core& core);

/// m_axi_ring_..., and `irq`.
[[nodiscard]] std::vector<Pin> ring_pins(const Core& core);
/// What the core's pins and those of the registers are joined to.
[[nodiscard]] std::map<std::string, std::string, std::less<>> ring_ends();
/// Lengths of bursts and what else is constant.
[[nodiscard]] std::string ring_assignments(const Core& core);
/// Bits of inputs that nothing reads.
[[nodiscard]] std::vector<std::string> ring_unused();

}  // namespace hitpipe::rtl
