// The FuseSoC core file (CAPI 2) of an emitted design: targets default, lint (Verilator), sim (Icarus) and
// synth (Yosys; Vivado with --tool). Paths are relative to the core file.
#pragma once

#include <string>

#include "rtl_gen/catalogue/design.hpp"

namespace hitpipe::rtl {

struct CoreParts {
  bool axi_stream = false;  ///< a fileset axis, and the wrapper is what lint and synth have as their top
  bool check = false;       ///< of a fitted unit: fileset and target check (lint), and sim checks operands
};

[[nodiscard]] std::string core_file(const Design& design, Format format, const CoreParts& parts);

}  // namespace hitpipe::rtl
