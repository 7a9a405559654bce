// The FuseSoC core file (CAPI 2, flow API) of an emitted design. Its targets are default, lint (Verilator),
// sim (Icarus), sim_verilator, harness (C++ around the Verilated unit), synth (Yosys) and synth_vivado. Paths
// are relative to the core file.
#pragma once

#include <string>

#include "rtl_gen/catalogue/design.hpp"

namespace hitpipe::rtl {

struct CoreParts {
  bool axi_stream = false;  ///< a fileset axis; the wrapper is the top of default, lint and synth
  bool fifo = false;        ///< a fileset fifo; that wrapper is the top of the same, if there is no axis
  std::string slots{};      ///< module of the wrapper with ray slots: a fileset slots, top of the same
  bool check = false;  ///< for a fitted unit: fileset and target check (lint); simulations check operands
};

[[nodiscard]] std::string core_file(const Design& design, Format format, const std::string& module,
                                    const CoreParts& parts);

}  // namespace hitpipe::rtl
