// A unit's Verilog beside its C++, with the tests of the rays that wait for it or are in it. In each cycle one ray
// sends its test; the tag tells whose it is. Every answer is compared with the C++ datapath.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "rtl_gen/catalogue/design.hpp"
#include "sim/cosim/counts.hpp"
#include "sim/cosim/sampled_time.hpp"
#include "sim/unit/verilated_design.hpp"

namespace hitpipe::sim {

/// How the C++ answers.
struct StationSoftware {
  rtl::Evaluate evaluate;  ///< the same datapath, bit by bit
  /// The same by the host's floating-point unit. It takes the place of `evaluate` in all tests but one in
  /// Station::bit_level_stride. Nothing: all tests are compared bit by bit.
  std::optional<rtl::Evaluate> on_float_unit{};
};

class Station {
 public:
  static constexpr int most_rays = 65'536;  ///< a tag has 16 bits
  /// A prime, so that the tests compared bit by bit are not always of the same rays.
  static constexpr int bit_level_stride = 61;

  /// Throws std::invalid_argument, one line, for a number of rays that is not allowed.
  Station(const VerilatedDesign& verilated, StationSoftware software, int rays);

  /// Throws std::invalid_argument, one line, for a number of rays that is not allowed.
  static void check(int rays);

  /// The ray has a test.
  void ask(std::size_t ray) { waiting_.push_back(ray); }
  [[nodiscard]] bool idle() const { return waiting_.empty() && sent_.empty(); }

  /// One cycle. write(ray, operands) gives the operands of a test that is sent; answered(ray, results) takes an
  /// answer. Throws WrongHardware when the Verilog loses a test.
  template <class Write, class Answered>
  void cycle(const Write& write, const Answered& answered);

  [[nodiscard]] const UnitCounts& counts() const { return counts_; }
  /// Time for the cycles of the Verilog alone, estimated from samples (sim/cosim/sampled_time.hpp).
  [[nodiscard]] double rtl_seconds() const { return rtl_time_.seconds(); }

 private:
  Model model_;
  StationSoftware software_;
  std::vector<std::int64_t> operands_, results_;
  std::deque<std::size_t> waiting_;
  std::deque<std::size_t> sent_;  // answers keep the order of the tests
  /// By ray: the results of its test in C++.
  std::vector<std::array<std::int64_t, rtl::Evaluate::most_results>> expected_;
  UnitCounts counts_;
  SampledTime<> rtl_time_;
  std::uint64_t tests_sent_ = 0;
  int silent_ = 0;  ///< cycles since an answer
  int longest_silence_;
};

template <class Write, class Answered>
void Station::cycle(const Write& write, const Answered& answered) {
  Pins pins{.results = results_.data()};
  const bool sending = !waiting_.empty();
  const std::size_t sender = sending ? waiting_.front() : 0;
  if (sending) {
    write(sender, operands_.data());
    pins.in_valid = true;
    pins.in_tag = static_cast<std::uint16_t>(sender);
  }
  rtl_time_.run([&] { model_.cycle(operands_.data(), pins); });
  ++counts_.cycles;
  if (sending && pins.in_ready) {
    const bool bit_level = !software_.on_float_unit || tests_sent_++ % bit_level_stride == 0;
    (bit_level ? software_.evaluate : *software_.on_float_unit)(operands_.data(), expected_[sender].data());
    counts_.bit_level_tests += bit_level ? 1 : 0;
    waiting_.pop_front();
    sent_.push_back(sender);
  }
  // A test is in the unit in every cycle.
  if (++silent_ > longest_silence_)
    throw WrongHardware(
        fmt::format("{}: no answer to a test within its latency", model_.design().unit().module()));
  if (!pins.out_valid) return;
  if (sent_.empty()) {
    ++counts_.rtl_mismatches;
    return;
  }
  silent_ = 0;
  const std::size_t ray = sent_.front();
  sent_.pop_front();
  bool same = pins.out_tag == ray;
  for (std::size_t i = 0; i < results_.size(); ++i) same = same && results_[i] == expected_[ray][i];
  ++counts_.tests;
  counts_.rtl_mismatches += same ? 0 : 1;
  answered(ray, std::as_const(results_).data());
}

}  // namespace hitpipe::sim
