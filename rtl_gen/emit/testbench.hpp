// What replays the vectors of a unit without hitpipe: a testbench in SystemVerilog and a C++ program around
// the unit as Verilator compiles it, from which engineers start their own.
#pragma once

#include <string>

#include "rtl_gen/verilog/module_interface.hpp"

namespace hitpipe::rtl {

/// tb/<module>_tb.sv in SystemVerilog, for Icarus Verilog and Verilator. It sends the vectors with gaps and
/// stalls, and compares every result and every tag. It prints "PASS <n> vectors"; or it prints "FAIL" with
/// the first mismatch or what is wrong with the file, and ends with $fatal. For a unit
/// without flow control there are gaps and no stalls, and in every cycle a result must be there exactly when
/// it is due, `latency` edges after its operands.
///
/// `around` are the wrappers of the unit; the testbench then is that of the outermost and replays the unit's
/// vectors through it.
struct Wrappers {
  bool fifo = false;
  bool axi_stream = false;
};
[[nodiscard]] std::string testbench(const ModuleInterface& unit, int count, int latency,
                                    const Wrappers& around = {});
/// tb/Makefile: icarus, verilator, harness and waves, for all units in the folder. It names none of them.
[[nodiscard]] std::string testbench_makefile();

/// Sends the `count` vectors of tb/<module>_vectors.hex with gaps and stalls, and compares every result and
/// every tag. Prints "PASS <n> vectors" and returns 0, or prints "FAIL" with the reason and returns 1. A unit
/// without flow control is driven as in testbench().
[[nodiscard]] std::string harness(const ModuleInterface& unit, int count, int latency);

}  // namespace hitpipe::rtl
