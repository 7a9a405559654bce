// The block picture of a core as Graphviz text: its machines with the bits of their memories, its units with
// their latencies, the bits between them, and the ports.
#pragma once

#include <string>

#include "rtl_gen/core/core.hpp"

namespace hitpipe::rtl {

/// The same core gives the same bytes.
[[nodiscard]] std::string to_dot(const Core& core);

}  // namespace hitpipe::rtl
