// Names in Verilog text, as a strict tool reads them: each is declared above its first use, and no two of a
// module differ in case alone.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace hitpipe::rtl {

/// One line for each name that is used above its declaration, or that differs from another one of its module
/// in case alone. A name that a module does not declare is not looked at: every tool refuses it.
[[nodiscard]] std::vector<std::string> faulty_names(std::string_view verilog);

}  // namespace hitpipe::rtl
