// A machine as files: Verilog, manifest, FuseSoC core, and a testbench that compares outputs and registers in every
// cycle.
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "host/files.hpp"
#include "rtl_gen/component/library.hpp"
#include "rtl_gen/machine/cycle_bench.hpp"
#include "rtl_gen/machine/machine.hpp"

namespace hitpipe::rtl {

/// Inputs for a test: numbers of all sizes, since a comparison of two random words is nearly always decided
/// by their top bits. About one cycle in a thousand resets, and the first one does.
class RandomCycles {
 public:
  RandomCycles(const MachineGraph& machine, std::uint64_t seed);
  /// The next one, with room for the rest.
  const MachineCycle& next();

 private:
  std::vector<int> widths_;
  std::mt19937_64 random_;
  MachineCycle cycle_;
  bool first_ = true;
};

struct MachineFilesOptions {
  std::string module{};  ///< empty: the machine's name, with the format behind it unless that is its own
  int cycles = 2000;     ///< of the testbench
  std::uint64_t seed = 1;
};

/// MODULE.v, MODULE.json, MODULE.core, MODULE.dot, tb/MODULE_tb.sv, tb/MODULE_vectors.hex, tb/Makefile. The same bytes
/// for the same arguments. Throws as Machine::graph() and longest_path() do.
[[nodiscard]] std::vector<host::File> machine_files(const Machine& machine, const Format& format,
                                                    const Library& library,
                                                    const MachineFilesOptions& options = {});

}  // namespace hitpipe::rtl
