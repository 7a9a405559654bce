// A unit's Verilog against the C++ of the whole design: random operands as demanded, offered with gaps and
// taken with stalls; all results and the tag are compared.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "sim/unit/verilated_design.hpp"

namespace hitpipe::sim {

struct VectorCheck {
  const VerilatedDesign* verilated;
  std::uint64_t vectors = 1'000'000;
  std::uint64_t seed = 1;
  /// Told the finished share, 0..1.
  std::function<void(double)> progress = [](double) {};
};

struct VectorResult {
  std::uint64_t vectors = 0;     ///< sent
  std::uint64_t hits = 0;        ///< by the C++
  std::uint64_t mismatches = 0;  ///< a wrong result, a wrong tag, or no answer
  std::string first_mismatch;    ///< "hit 0 tag 7, expected hit 1 tag 7 of vector 7 of seed 1: irx=0x5 ..."
};

[[nodiscard]] VectorResult check_vectors(const VectorCheck& check);

}  // namespace hitpipe::sim
