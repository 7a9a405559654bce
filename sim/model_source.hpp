// The C++ that wraps a Verilated design behind the entry points of pins.hpp.
#pragma once

#include <string>
#include <vector>

#include "rtl_gen/catalogue/design.hpp"

namespace hitpipe::sim {

[[nodiscard]] std::string model_source(const std::string& module, const std::vector<rtl::Port>& operands);

}  // namespace hitpipe::sim
