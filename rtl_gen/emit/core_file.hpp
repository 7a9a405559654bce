// The FuseSoC core file (CAPI 2) of an emitted design: targets default, lint (Verilator), sim (Icarus) and
// synth (Yosys; Vivado with --tool). Paths are relative to the core file.
#pragma once

#include <string>

#include "rtl_gen/catalogue/design.hpp"

namespace hitpipe::rtl {

/// With `axi_stream` there is a fileset axis too, and the wrapper is what lint and synth have as their top.
[[nodiscard]] std::string core_file(const Design& design, Format format, bool axi_stream);

}  // namespace hitpipe::rtl
