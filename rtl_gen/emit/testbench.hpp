// Vectors for a design and a Verilog testbench that replays them: any simulator, no hitpipe needed.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "rtl_gen/catalogue/design.hpp"

namespace hitpipe::rtl {

/// Operand values for every port: corners (all zeros, extremes, +-1) first, then random ones, all from the
/// seed.
[[nodiscard]] std::vector<std::vector<std::int64_t>> operand_vectors(const std::vector<Port>& ports,
                                                                     int count, std::uint64_t seed);

/// One vector a line, hexadecimal: the operands, first port in the high bits, and the expected HIT in bit 0.
[[nodiscard]] std::string vector_file(const std::vector<Port>& ports, Evaluate evaluate, int count,
                                      std::uint64_t seed);

/// Drives the vectors with gaps and stalls, compares every HIT and every tag, ends with "PASS <n> vectors" or
/// the first mismatch and $fatal's equivalent of Verilog-2001.
[[nodiscard]] std::string testbench(const Design& design, const std::vector<Port>& ports, int count);

}  // namespace hitpipe::rtl
