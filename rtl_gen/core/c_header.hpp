// What software in C knows of a core.
#pragma once

#include <string>

#include "rtl_gen/core/core.hpp"

namespace hitpipe::rtl {

/// MODULE.h: registers and records. Names in it are those of every core, so one driver takes any of them.
[[nodiscard]] std::string c_header(const Core& core);

}  // namespace hitpipe::rtl
