// The receiver and the transmitter of a serial line: a start bit, eight data bits from the lowest on, a stop
// bit.
#pragma once

#include <string>

namespace hitpipe::rtl {

/// The modules PREFIX_rx and PREFIX_tx.
[[nodiscard]] std::string serial_line(const std::string& prefix);

}  // namespace hitpipe::rtl
