// Drives a unit behind ray slots at random: rays are written to slots whose tests are under way or are sent
// in the same cycle, whole or only at their ends, with gaps, stalls and resets. Every answer must be the
// answer of the ray that its slot held when the test was taken.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/unit/verilated_design.hpp"

namespace hitpipe::sim {

struct SlotReport {
  std::uint64_t received = 0;
  std::uint64_t hits = 0;
  std::uint64_t wrong_answers = 0;     ///< results or tag
  std::uint64_t surplus = 0;           ///< answers to no test
  std::uint64_t lost = 0;              ///< tests without an answer
  std::uint64_t not_held = 0;          ///< an answer that was not taken changed or went
  std::uint64_t beside_write = 0;      ///< tests that were taken at the edge of a write to their slot
  std::uint64_t refused = 0;           ///< in_ready was low without a reason
  std::uint64_t write_refused = 0;     ///< ray_ready was low
  std::uint64_t waited_for_write = 0;  ///< tests that a write to their slot kept waiting
  std::uint64_t under_way = 0;         ///< writes to a slot with tests that had no answer yet
  std::uint64_t ends = 0;              ///< writes of an end only
  std::uint64_t resets = 0;

  [[nodiscard]] std::uint64_t faults() const {
    return wrong_answers + surplus + lost + not_held + beside_write + refused + write_refused;
  }
};

/// Until `tests` answers have come. Each vector has a ray and a box that belong together. The design must
/// have ray slots.
[[nodiscard]] SlotReport slot_traffic(const VerilatedDesign& design, const rtl::Evaluate& evaluate,
                                      const std::vector<std::vector<std::int64_t>>& vectors,
                                      std::uint64_t tests, std::uint64_t seed);

}  // namespace hitpipe::sim
