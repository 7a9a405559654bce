// Which names a unit's module may have.
#pragma once

#include <string>

namespace hitpipe::rtl {

/// The name also begins the names of files, of other modules, of C++ functions and of what Verilator makes.
/// It has letters, digits and single underscores, begins with a letter, and is no keyword of Verilog,
/// SystemVerilog or C++. Throws std::runtime_error, one line, for any other.
void check_module_name(const std::string& name);

}  // namespace hitpipe::rtl
