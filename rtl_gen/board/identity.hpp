// What a board says of the unit on it, so that nobody compares answers of the wrong bitstream.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "rtl_gen/catalogue/design.hpp"

namespace hitpipe::rtl {

/// The number of the protocol in docs/board.md.
inline constexpr int board_protocol = 1;

/// A hash of the ports, of the results, and of the answers to 1000 drawn operands. Two units with the same
/// fingerprint take the same bits and mean the same by them; how their Verilog is cut into stages or blocks
/// does not matter.
[[nodiscard]] std::uint64_t fingerprint(const Design& design, const Format& format);

/// "hitpipe 1 int_slabs 16/16 0123456789abcdef": protocol, design, format, fingerprint.
[[nodiscard]] std::string board_identity(const Design& design, const Format& format);

}  // namespace hitpipe::rtl
