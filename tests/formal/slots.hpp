// Verilog with the properties that yosys-smtbmc proves about a memory of rays before a unit (docs/formal.md).
#pragma once

#include <string>
#include <vector>

#include "rtl_gen/emit/ray_slots.hpp"

namespace hitpipe::formal {

/// The wrapper with a few slots around a stand-in for the unit, which shows its operands and takes them when
/// it likes; and properties in the wrapper. The unit itself plays no part in them.
[[nodiscard]] std::string slots_proof(const std::string& unit, const std::vector<rtl::Port>& operands);

}  // namespace hitpipe::formal
