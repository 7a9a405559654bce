// The serial line of a board's top module, in Verilog: eight data bits, no parity, one stop bit.
#pragma once

#include <string>

namespace hitpipe::rtl {

/// The modules PREFIX_rx, which receives bytes, and PREFIX_tx, which sends them.
[[nodiscard]] std::string serial_line(const std::string& prefix);

}  // namespace hitpipe::rtl
