// Drives a Verilated design with tests at random gaps and stalls, and checks what a unit around it relies on:
// every answer is that of the C++ datapath, comes once, in order, with its tag, and is held until it is
// taken.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "sim/verilated_design.hpp"

namespace hitpipe::sim {

/// How a run offers and takes: the shares of cycles with in_valid and with out_ready, 0 < share <= 1; and the
/// share of cycles with a reset, well below one in each length of the pipeline.
struct Traffic {
  const char* name;
  double offered;
  double taken;
  double reset = 0;
};

struct TestbenchReport {
  std::uint64_t sent = 0;  ///< without those that a reset dropped, which are sent again
  std::uint64_t received = 0;
  std::uint64_t hits = 0;           ///< answers that are HIT
  std::uint64_t wrong_results = 0;  ///< a result differs from the C++ datapath
  std::uint64_t wrong_tags = 0;     ///< tag is not that of the oldest test without an answer
  std::uint64_t surplus = 0;        ///< answers to no test
  std::uint64_t lost = 0;           ///< tests that were never answered
  std::uint64_t not_held = 0;       ///< an answer that was not taken changed or went
  std::uint64_t wrong_ready = 0;    ///< in_ready is not "no answer waits to be taken"
  std::uint64_t resets = 0;
  std::uint64_t dropped = 0;  ///< tests that were in flight at a reset: their answers must not come
  std::uint64_t stalls = 0;   ///< cycles in which an answer waited: what was checked to be held
  std::string first_failure;  ///< operands in hexadecimal, tag, seed

  [[nodiscard]] bool clean() const {
    return wrong_results + wrong_tags + surplus + lost + not_held + wrong_ready == 0;
  }
  TestbenchReport& operator+=(const TestbenchReport& other);
};

/// Sends all vectors, with operands in port order. The seed decides gaps, stalls and tags. `vector_seed` made
/// the vectors; it is only printed.
[[nodiscard]] TestbenchReport drive(Model& model, const std::vector<rtl::Port>& ports, rtl::Evaluate evaluate,
                                    const std::vector<std::vector<std::int64_t>>& vectors,
                                    const Traffic& traffic, std::uint64_t seed, std::uint64_t vector_seed);

}  // namespace hitpipe::sim
