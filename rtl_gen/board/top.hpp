// A unit as the whole of a chip: operands come over a serial line and results go back. The module takes
// frames (docs/chips.md) and answers each with a frame. It has one clock. It says which unit it contains, so
// that nobody compares answers of the wrong bitstream.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "rtl_gen/catalogue/design.hpp"
#include "rtl_gen/pipeline.hpp"
#include "rtl_gen/verilog/module_interface.hpp"

namespace hitpipe::rtl {

/// The number of the protocol in docs/chips.md.
inline constexpr int board_protocol = 1;

/// A hash of the ports, of the results, and of the answers to 1000 drawn operands. Two units with the same
/// fingerprint take the same bits and mean the same by them; how their Verilog is cut into stages or blocks
/// does not matter.
[[nodiscard]] std::uint64_t fingerprint(const Design& design, const Format& format);

/// "hitpipe 1 int_slabs 16/16 0123456789abcdef": protocol, design, format, fingerprint.
[[nodiscard]] std::string board_identity(const Design& design, const Format& format);

/// The ports of the top module. Button and lamps are active low.
inline constexpr std::array<std::string_view, 6> top_ports{"clk",      "rx",        "tx",
                                                           "button_n", "led_red_n", "led_green_n"};

struct BoardUnit {
  ModuleInterface unit;
  std::string identity;  ///< what it answers to the question who it is, in ASCII
  int interval = 1;      ///< it takes a test every so many cycles
};

/// Of the whole unit of that name, made from the design at the format.
[[nodiscard]] BoardUnit board_unit(const Design& design, const Format& format, const std::string& module,
                                   const Pipeline& pipeline);

/// Bytes of a test's operands, and of its results: all bits together, rounded up.
[[nodiscard]] int packed_bytes(const std::vector<Port>& ports);

/// "int_slabs_board" for the unit int_slabs.
[[nodiscard]] std::string board_module(const std::string& unit);
/// The top module and its serial receiver and transmitter in Verilog-2001, without the unit's module.
/// `clocks_per_bit`, 4..65535, becomes the default of the parameter CLOCKS_PER_BIT.
[[nodiscard]] std::string board_top(const BoardUnit& unit, int clocks_per_bit);

}  // namespace hitpipe::rtl
