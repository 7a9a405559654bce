// The registers of a core in SystemRDL 2.0, from which other tools make register models, headers and pages.
#pragma once

#include <string>

#include "rtl_gen/core/core.hpp"

namespace hitpipe::rtl {

/// One addrmap, named as the module behind AXI; registers and fields are named as in the manifest.
[[nodiscard]] std::string system_rdl(const Core& core);

}  // namespace hitpipe::rtl
