// Vectors for a design and a testbench that replays them in a simulator, without hitpipe.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "rtl_gen/catalogue/design.hpp"
#include "rtl_gen/prune/draw.hpp"

namespace hitpipe::rtl {

/// Operands for every port, drawn from the seed. Of four vectors the first has corner values (0, 1, -1, the
/// extremes, alternating bits), the second numbers near 0, the other two any numbers.
[[nodiscard]] std::vector<std::vector<std::int64_t>> operand_vectors(const std::vector<Port>& ports,
                                                                     int count, std::uint64_t seed);
/// The operands with their results.
[[nodiscard]] std::vector<Vector> judged(std::vector<std::vector<std::int64_t>> operands,
                                         const Evaluate& evaluate);

/// One vector a line, hexadecimal: the operands, first port in the high bits, then the expected results, last
/// result in the low bits. Vectors hold operands of all `ports`; the file has only those of the ports that
/// are `left`.
[[nodiscard]] std::string vector_file(const std::vector<Port>& ports, const std::vector<Port>& left,
                                      const std::vector<hls::Result>& results,
                                      const std::vector<Vector>& vectors);

/// tb/<module>_tb.sv in SystemVerilog, for Icarus Verilog and Verilator. It sends the vectors with gaps and
/// stalls, and compares every result and every tag. It prints "PASS <n> vectors"; or it prints "FAIL" with
/// the first mismatch or what is wrong with the file, and ends with $fatal. With a `fixed_latency` the unit
/// has no ready: there are gaps and no stalls, and in every cycle a result must be there exactly when one is
/// due.
[[nodiscard]] std::string testbench(const std::string& module, const std::vector<Port>& ports,
                                    const std::vector<hls::Result>& results, int count,
                                    std::optional<int> fixed_latency = {});
/// tb/Makefile: icarus, verilator, harness and waves, for all units in the folder. It names none of them.
[[nodiscard]] std::string testbench_makefile();

}  // namespace hitpipe::rtl
