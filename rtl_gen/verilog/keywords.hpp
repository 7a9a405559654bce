// The words that cannot be names.
#pragma once

#include <set>
#include <string>

namespace hitpipe::rtl {

/// Of Verilog (IEEE 1364-2001) and of SystemVerilog (IEEE 1800-2012): some tools read every design as
/// SystemVerilog.
[[nodiscard]] const std::set<std::string>& verilog_keywords();
/// Of C++20.
[[nodiscard]] const std::set<std::string>& cpp_keywords();

}  // namespace hitpipe::rtl
