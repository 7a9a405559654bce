// The vectors that a testbench replays, in groups by where they come from, and their file.
#pragma once

#include <cstdint>
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
[[nodiscard]] std::vector<Vector> with_results(std::vector<std::vector<std::int64_t>> operands,
                                               const Evaluate& evaluate);

struct VectorGroup {
  std::string from;  ///< "corners", or the name of a category of rays and boxes
  std::vector<Vector> vectors;
};

struct VectorSet {
  std::uint64_t seed = 0;
  std::vector<VectorGroup> groups;

  [[nodiscard]] std::size_t size() const;
  /// All, group by group.
  [[nodiscard]] std::vector<Vector> all() const;
};

/// How many of them hit a box or, of a design without HIT, have no error.
[[nodiscard]] std::size_t hits(const std::vector<Vector>& vectors, const std::vector<hls::Result>& results);

/// One vector a line, hexadecimal: the operands, first port in the high bits, then the expected results, last
/// result in the low bits. Vectors hold operands of all `ports`; the file has operands of the ports
/// that are `left`.
[[nodiscard]] std::string vector_file(const std::vector<Port>& ports, const std::vector<Port>& left,
                                      const std::vector<hls::Result>& results,
                                      const std::vector<Vector>& vectors);

/// Comment lines at the head of the vector file: the unit, the seed, how many vectors hit, and the lines of
/// each group.
[[nodiscard]] std::string vector_summary(const std::string& unit, const VectorSet& set,
                                         const std::vector<hls::Result>& results);

}  // namespace hitpipe::rtl
