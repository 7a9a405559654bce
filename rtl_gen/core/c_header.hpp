// What software in C knows of a core.
#pragma once

#include <string>

#include "rtl_gen/core/core.hpp"

namespace hitpipe::rtl {

/// The module's name in capitals, which begins the names of macros.
[[nodiscard]] std::string macro_name(const Core& core);
/// MODULE.h: registers and records.
[[nodiscard]] std::string c_header(const Core& core);

}  // namespace hitpipe::rtl
