// The C++ that wraps a Verilated design behind the entry points of pins.hpp.
#pragma once

#include <string>
#include <vector>

#include "rtl_gen/catalogue/design.hpp"

namespace hitpipe::sim {

/// `ports` are the module's, each named as one of the operands, of which it takes as many low bits as it has.
/// `results` are the design's, each an output of the module.
[[nodiscard]] std::string model_source(const std::string& module, const std::vector<rtl::Port>& operands,
                                       const std::vector<rtl::Port>& ports,
                                       const std::vector<hls::Result>& results);

}  // namespace hitpipe::sim
