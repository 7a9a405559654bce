// A testbench of whole cycles: a line of a file says what goes in, what comes out before the clock edge, and
// what the registers hold behind it. Machines and cores have one.
#pragma once

#include <string>
#include <vector>

#include "rtl_gen/graph/word.hpp"

namespace hitpipe::rtl {

/// What goes into a machine in a cycle and, where a run says so, what its software makes of it.
struct MachineCycle {
  bool reset = false;
  std::vector<Word> inputs, outputs;
  std::vector<Word> state{};  ///< behind the edge
};

struct CycleTest {
  struct Pin {
    std::string name;
    int width;
    std::string when{};  ///< of an output: it means something where this holds, "want_valid"; empty: always
  };

  std::string module;
  std::vector<Pin> inputs, outputs, registers;
  std::string begins_with{};  ///< statements before the first cycle
  std::vector<MachineCycle> cycles;
};

/// tb/MODULE_tb.sv. It prints PASS, or the first name that differs, and then it fails.
[[nodiscard]] std::string testbench_text(const CycleTest& test);
/// tb/MODULE_vectors.hex, which it reads.
[[nodiscard]] std::string vectors_text(const CycleTest& test);

}  // namespace hitpipe::rtl
