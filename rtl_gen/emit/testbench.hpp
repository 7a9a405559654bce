// Vectors for a design and a Verilog testbench that replays them: any simulator, no hitpipe needed.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "rtl_gen/catalogue/design.hpp"
#include "rtl_gen/prune/draw.hpp"

namespace hitpipe::rtl {

/// Operand values for every port: corners (all zeros, extremes, +-1) first, then random ones, all from the
/// seed.
[[nodiscard]] std::vector<std::vector<std::int64_t>> operand_vectors(const std::vector<Port>& ports,
                                                                     int count, std::uint64_t seed);
/// With their HIT.
[[nodiscard]] std::vector<Vector> judged(std::vector<std::vector<std::int64_t>> operands, Evaluate evaluate);

/// One vector a line, hexadecimal: the operands, first port in the high bits, and the expected HIT in bit 0.
/// Vectors hold operands of all `ports`; the ports that are `left` of them are written.
[[nodiscard]] std::string vector_file(const std::vector<Port>& ports, const std::vector<Port>& left,
                                      const std::vector<Vector>& vectors);

/// Drives the vectors with gaps and stalls, compares every HIT and every tag, ends with "PASS <n> vectors" or
/// the first mismatch and $fatal's equivalent of Verilog-2001.
[[nodiscard]] std::string testbench(const Design& design, const std::vector<Port>& ports, int count);

}  // namespace hitpipe::rtl
