// The divider's Verilog beside its C++, with the tests that wait for it or are in it.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <memory>
#include <vector>

#include "hls/world/core_format.hpp"
#include "sim/cosim/counts.hpp"
#include "sim/machine/verilated_machine.hpp"

namespace hitpipe::sim {

inline constexpr const char* divider_name = "divider";

/// Of the divider that co-simulation puts behind a triangle unit: it has a place for 32 tests.
[[nodiscard]] constexpr hls::CoreBits divider_format(const hls::WorldBits& world) {
  constexpr int ray_bits = 5;
  return {world, ray_bits};
}

/// What the divider must know of the ray whose test it divides.
struct BestHit {
  std::uint32_t number;  ///< of the triangle that it was tested with
  std::int64_t t;        ///< of the best hit; the length before the first
  std::uint32_t best_number;
};

/// The divider, with the tests that wait for it or are in it.
class DividerStation {
 public:
  DividerStation(const VerilatedMachine& divider, const hls::CoreBits& bits)
      : verilog_(divider.another()),
        native_(rtl::machine_called(divider_name)->native(bits)),
        owners_(static_cast<std::size_t>(bits.rays())) {
    for (std::uint32_t i = 0; i < owners_.size(); ++i) free_.push_back(i);
    const Inputs none{};
    native_->step(none.data(), true);
    verilog_->step(none.data(), true);
  }

  /// `results` of a test with HIT: det and num in halves.
  void ask(std::uint32_t ray, const std::array<std::int64_t, 4>& halves) {
    waiting_.push_back({ray, halves});
  }
  [[nodiscard]] bool idle() const { return waiting_.empty() && free_.size() == owners_.size(); }
  [[nodiscard]] UnitCounts& counts() { return counts_; }
  [[nodiscard]] const UnitCounts& counts() const { return counts_; }

  /// One cycle. best(ray) gives a BestHit; answered(ray, t, closer) takes an answer.
  template <class Best, class Answered>
  void cycle(const Best& best, const Answered& answered) {
    Inputs in{};
    if (!waiting_.empty() && !free_.empty()) {
      const Waiting& next = waiting_.front();
      const std::uint32_t place = free_.front();
      free_.pop_front();
      owners_[place] = next.ray;
      in[0] = in[1] = 1;
      in[2] = place;
      for (std::size_t i = 0; i < next.halves.size(); ++i)
        in[3 + i] = static_cast<rtl::Word>(static_cast<std::uint64_t>(next.halves[i]));
      waiting_.pop_front();
    }
    const BestHit found = best(owners_[asked_]);
    in[7] = found.number;
    in[8] = static_cast<rtl::Word>(found.t);
    in[9] = found.best_number;
    Outputs out, expected;
    native_->outputs(expected.data());
    verilog_->outputs(out.data());
    native_->step(in.data(), false);
    verilog_->step(in.data(), false);
    ++counts_.cycles;
    if (out != expected) ++counts_.rtl_mismatches;
    asked_ = static_cast<std::size_t>(out[0]);
    if (out[1] == 0) {
      if (++silent_ > longest_silence) throw WrongHardware("divider: no answer");
      return;
    }
    silent_ = 0;
    ++counts_.tests;
    counts_.hits += out[3] != 0 ? 1 : 0;
    free_.push_back(static_cast<std::uint32_t>(asked_));
    answered(owners_[asked_], static_cast<std::int64_t>(out[2]), out[3] != 0);
  }

 private:
  using Inputs = std::array<rtl::Word, 10>;
  using Outputs = std::array<rtl::Word, 4>;
  static constexpr int longest_silence = 100;
  struct Waiting {
    std::uint32_t ray;
    std::array<std::int64_t, 4> halves;
  };

  std::unique_ptr<VerilatedMachine> verilog_;
  std::unique_ptr<rtl::NativeMachine> native_;
  std::vector<std::uint32_t> owners_;  ///< rays, by their number in the divider
  std::deque<std::uint32_t> free_;
  std::deque<Waiting> waiting_;
  UnitCounts counts_;
  std::size_t asked_ = 0;
  int silent_ = 0;
};

}  // namespace hitpipe::sim
