// The schematic of a pipeline, stage by stage, as Graphviz text: the symbols are the thesis's (section 7.3).
//   "-" subtract   "x" multiply   "<>" compare   "2:1" multiplexer   "L:24" a 24-bit latch   a bubble inverts
#pragma once

#include <string>

#include "rtl_gen/pipeline.hpp"

namespace hitpipe::rtl {

[[nodiscard]] std::string to_dot(const Pipeline& pipeline, const std::string& title);

}  // namespace hitpipe::rtl
