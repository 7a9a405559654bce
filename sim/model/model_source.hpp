// The C++ that wraps a Verilated design behind the entry points of pins.hpp.
#pragma once

#include <string>
#include <vector>

#include "rtl_gen/catalogue/design.hpp"
#include "rtl_gen/verilog/module_interface.hpp"

namespace hitpipe::sim {

/// A struct Model with the module as `top`, and the entry points that make and end one. `includes` are lines
/// for what follows.
[[nodiscard]] std::string instance_source(const std::string& module, const std::string& includes = "");

/// Each of the module's `ports` has an operand's name and takes its low `width` bits. `results` are the
/// design's, each an output of the module.
[[nodiscard]] std::string model_source(const std::string& module, const std::vector<rtl::Port>& operands,
                                       const std::vector<rtl::Port>& ports,
                                       const std::vector<hls::Result>& results, rtl::FlowControl flow,
                                       int interval = 1);

}  // namespace hitpipe::sim
