// The block picture of parts that are joined as Graphviz text: machines with the bits of their memories, units with
// their latencies, the bits between them, and the module's own pins.
#pragma once

#include <string>

#include "rtl_gen/core/core.hpp"
#include "rtl_gen/part/assembly.hpp"

namespace hitpipe::rtl {

// The same bytes for the same core.
/// Of what is in it.
[[nodiscard]] std::string core_picture(const Core& core);
/// Of it behind AXI.
[[nodiscard]] std::string axi_picture(const Core& core);

}  // namespace hitpipe::rtl
