// The block picture of a machine as Graphviz text: its inputs, registers, memories and outputs, with widths,
// and which of them the others depend on. A register whose name ends in _N stands in cycle N of what the
// machine does with one thing; the others are kept from cycle to cycle.
#pragma once

#include <string>

#include "rtl_gen/machine/machine.hpp"

namespace hitpipe::rtl {

/// The same machine gives the same bytes.
[[nodiscard]] std::string to_dot(const MachineGraph& machine, const std::string& title);

}  // namespace hitpipe::rtl
