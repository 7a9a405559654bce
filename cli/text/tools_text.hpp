// Which hardware tools the program finds.
#pragma once

#include <string>

namespace hitpipe::cli {

/// A line for each of Verilator, Yosys and Icarus: "Yosys: /usr/bin/yosys, Yosys 0.23", or "Yosys: not found".
[[nodiscard]] std::string tools_text();

}  // namespace hitpipe::cli
