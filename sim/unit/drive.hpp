// Sends tests through a unit's Verilog, with gaps, stalls and resets if wanted, and checks what a unit around
// it relies on: every answer is the C++ datapath's, comes once, in order, with its tag, and is held until it
// is taken.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "sim/unit/verilated_design.hpp"

namespace hitpipe::sim {

/// Tests, and what the Verilog must answer to each.
class TestBatch {
 public:
  TestBatch() = default;
  TestBatch(const std::vector<std::vector<std::int64_t>>& operands, const rtl::Evaluate& evaluate);
  void add(std::span<const std::int64_t> operands, std::span<const std::int64_t> results);

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] std::span<const std::int64_t> operands(std::size_t test) const;
  [[nodiscard]] std::span<const std::int64_t> results(std::size_t test) const;

 private:
  std::size_t size_ = 0;
  std::vector<std::int64_t> operands_, results_;
};

/// How a run offers and takes: the shares of cycles with in_valid and with out_ready, 0 < share <= 1; and the
/// share of cycles with a reset, well below one in each length of the pipeline.
struct Traffic {
  const char* name = "";
  double offered = 1;
  double taken = 1;
  double reset = 0;
};

struct DriveOptions {
  Traffic traffic{};
  std::uint64_t seed = 1;         ///< of gaps, stalls and resets
  std::uint64_t first = 0;        ///< number of the first test
  std::uint16_t tag_step = 1;     ///< tag = number * tag_step; odd
  std::uint64_t vector_seed = 1;  ///< made the tests; it is only printed
};

struct DriveReport {
  std::uint64_t sent = 0;  ///< without those that a reset dropped, which are sent again
  std::uint64_t received = 0;
  std::uint64_t hits = 0;           ///< verdicts that are yes (rtl::Verdict)
  std::uint64_t wrong = 0;          ///< answers with a wrong result, a wrong tag or both
  std::uint64_t wrong_results = 0;  ///< a result differs from the C++ datapath
  std::uint64_t wrong_tags = 0;     ///< not the tag of the oldest test without an answer
  std::uint64_t surplus = 0;        ///< answers to no test
  std::uint64_t lost = 0;           ///< tests that were never answered
  std::uint64_t not_held = 0;       ///< an answer that was not taken changed or went
  std::uint64_t wrong_ready = 0;    ///< in_ready is not "no answer waits to be taken"
  std::uint64_t resets = 0;
  std::uint64_t dropped = 0;  ///< tests that were in flight at a reset: their answers must not come
  std::uint64_t stalls = 0;   ///< cycles in which an answer waited: what was checked to be held
  /// "hit 0 tag 7, expected hit 1 tag 7 of vector 7 of seed 1: irx=0x5 ..."
  std::string first_failure;

  [[nodiscard]] std::uint64_t faults() const { return wrong + surplus + lost + not_held + wrong_ready; }
  [[nodiscard]] bool clean() const { return faults() == 0; }
  DriveReport& operator+=(const DriveReport& other);
};

/// Sends all tests. Throws std::invalid_argument when they do not have the unit's operands and results.
[[nodiscard]] DriveReport drive(Model& model, const TestBatch& tests, const DriveOptions& options = {});

struct VectorCheck {
  const VerilatedDesign* verilated;
  std::uint64_t vectors = 1'000'000;
  std::uint64_t seed = 1;
  /// Told the finished share, 0..1.
  std::function<void(double)> progress = [](double) {};
};

struct VectorResult {
  std::uint64_t vectors = 0;     ///< sent
  std::uint64_t hits = 0;        ///< verdicts that are yes, by the C++
  std::uint64_t mismatches = 0;  ///< a wrong result, a wrong tag, or no answer
  std::string first_mismatch;    ///< "hit 0 tag 7, expected hit 1 tag 7 of vector 7 of seed 1: irx=0x5 ..."
};

[[nodiscard]] VectorResult check_vectors(const VectorCheck& check);

}  // namespace hitpipe::sim
