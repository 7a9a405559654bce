// The FuseSoC core file (CAPI 2) of an emitted design: targets default, lint (Verilator), sim (Icarus) and
// synth (Yosys; Vivado with --tool). Paths are relative to the core file.
#pragma once

#include <string>

#include "rtl_gen/catalogue/design.hpp"

namespace hitpipe::rtl {

struct CoreParts {
  bool axi_stream = false;  ///< a fileset axis; the wrapper is the top of lint and synth
  bool check = false;       ///< for a fitted unit: fileset and target check (lint); sim checks operands
};

[[nodiscard]] std::string core_file(const Design& design, Format format, const std::string& module,
                                    const CoreParts& parts);

}  // namespace hitpipe::rtl
