// Operands of one's own, from a CSV file: what the unit answers to them. Nobody judges, because there is no
// ray and no box.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "sim/operands/test_text.hpp"

namespace hitpipe::sim {

struct RunCounts {
  std::uint64_t tests = 0;
  std::uint64_t hits = 0;  ///< of boxes: a test may have two
};

/// Writes the head of the layout and then each line of the file with its results. The file has a column for
/// each operand; columns that `hitpipe operands` also writes are left aside. A number is decimal, or the
/// pattern of the port's bits in hexadecimal. "-" is standard input. Throws std::runtime_error, one line that
/// names file, line, what is wrong and what is allowed. `progress` is told the finished share of the file, if
/// that is known.
RunCounts run_operands(const rtl::Design& design, const Format& format, const std::string& file,
                       TestForm form, const std::function<void(std::string_view)>& write,
                       const std::function<void(double)>& progress);

}  // namespace hitpipe::sim
