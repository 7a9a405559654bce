// The operands of many tests: line i of a file of rays with line i of a file of boxes, or every ray with
// every box. The C++ datapath and exact arithmetic answer each test. Memory does not depend on the number of
// lines, except that the boxes are kept if every ray meets them all.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "sim/operands/test_text.hpp"
#include "sim/software/box_software.hpp"

namespace hitpipe::sim {

struct OperandFiles {
  std::string rays;   ///< "-": standard input
  std::string boxes;  ///< "-": standard input, if rays are not
  bool all_pairs = false;
};

/// Of boxes: a test may have two.
struct OperandCounts {
  std::uint64_t tests = 0;
  std::uint64_t hits = 0;        ///< by the unit
  std::uint64_t exact_hits = 0;  ///< by exact arithmetic
  std::uint64_t false_hits = 0;
  std::uint64_t false_misses = 0;
  /// Lines of the first false miss, in the files.
  struct Place {
    std::uint64_t ray_line;
    std::uint64_t box_line;
  };
  std::optional<Place> false_miss{};

  OperandCounts& operator+=(const OperandCounts& later);
};

struct OperandOptions {
  OperandFiles files;
  Placement placement;
  int threads = 1;  ///< results do not depend on it
  /// Told the finished share of the rays' file, if it is known.
  std::function<void(double)> progress = [](double) {};
};

/// Writes the head and then all tests in order. Throws std::runtime_error, one line that names file, line,
/// what is wrong and what is allowed.
OperandCounts write_operands(const MakeBoxTest& make, const TestLayout& layout, const OperandOptions& options,
                             const std::function<void(std::string_view)>& write);

}  // namespace hitpipe::sim
