// What a ray unit counts while it traces, and what it throws when the hardware does not answer.
#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>

namespace hitpipe::sim {

struct UnitCounts {
  std::uint64_t tests = 0;      ///< through the pipeline
  std::uint64_t box_tests = 0;  ///< boxes that they answered for: as many, or up to twice as many
  std::uint64_t triangle_tests = 0;
  std::uint64_t hits = 0;  ///< boxes with HIT
  /// A result of the Verilog differs from the C++ datapath, or comes back with another ray's tag.
  std::uint64_t rtl_mismatches = 0;
  std::optional<std::uint64_t> false_misses;  ///< counted by the exact referee; nothing without it
  std::optional<std::uint64_t> false_hits;
  std::uint64_t cycles = 0;
  std::uint64_t bit_level_tests = 0;  ///< tests whose results were compared with the bit-level C++ datapath

  /// Zeros. The referee's counts are there only with a referee.
  [[nodiscard]] static UnitCounts zeros(bool referee);
  /// The referee's counts of the sum are there when both sides have them.
  UnitCounts& operator+=(const UnitCounts& other);
  friend bool operator==(const UnitCounts&, const UnitCounts&) = default;
};

/// How much more than the reference, in percent. 0 when that is 0.
[[nodiscard]] inline double percent_above(std::uint64_t value, std::uint64_t reference) {
  return reference == 0 ? 0.0 : 100.0 * (static_cast<double>(value) / static_cast<double>(reference) - 1.0);
}

/// Thrown when the hardware itself is wrong and the run cannot go on. Bad input throws other exceptions.
class WrongHardware : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace hitpipe::sim
