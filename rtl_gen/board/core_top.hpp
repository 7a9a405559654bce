// A core as the whole of a chip: an image and rays come over a serial line and hits go back. The image lies
// in a memory of the chip, which the machine scene_memory reads. The module takes the frames that
// docs/chips.md describes.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "rtl_gen/component/library.hpp"
#include "rtl_gen/core/core.hpp"

namespace hitpipe::rtl {

/// Fields of a ray in a frame, ray_any to ray_length, and of a hit: hit_failed, hit_number, hit_t.
[[nodiscard]] std::vector<Port> board_ray_ports(const Core& core);
[[nodiscard]] std::vector<Port> board_hit_ports(const Core& core);

/// "hitpipe 1 core 12+0/7s12 0123456789abcdef": protocol, format, and a hash of the fields and of what the
/// core has room for.
[[nodiscard]] std::string core_identity(const Core& core);

/// How many rays may be on their way to a board: those in the core, and one that waits in front of it. One
/// more could come while that one waits, and would be lost.
[[nodiscard]] int rays_on_their_way(const Core& core);
/// Blocks that the memory of the chip has.
[[nodiscard]] std::size_t board_blocks(const Core& core);

/// The top module, its memory and its serial line in Verilog-2001, without the core. The core takes integers,
/// its tags have eight bits, and its addresses are those of the image: throws std::logic_error otherwise.
/// `clocks_per_bit`, 4..65535, becomes the default of the parameter CLOCKS_PER_BIT.
[[nodiscard]] std::string core_board_top(const Core& core, int clocks_per_bit);

}  // namespace hitpipe::rtl
