// A core twice, which is compared with itself.
#pragma once

#include <string>
#include <vector>

#include <fmt/format.h>

#include "sim/core/native_core.hpp"
#include "sim/machine/verilated_machine.hpp"

namespace hitpipe::sim::core_pictures {

/// The core in software and in Verilog. All outputs are compared in every cycle.
class BothCores final : public rtl::NativeMachine {
 public:
  BothCores(const rtl::Core& core, const std::string& verilog)
      : core_(core), native_(core), verilog_(core, verilog), other_(core.ports.size()) {}

  void outputs(rtl::Word* outputs) override {
    native_.outputs(outputs);
    verilog_.outputs(other_.data());
    std::size_t place = 0;
    for (const rtl::CorePort& port : core_.ports) {
      if (port.pin.is_input) continue;
      if (first_difference.empty() && started_ && outputs[place] != other_[place])
        first_difference = fmt::format("{} in cycle {}", port.pin.name, cycle_);
      ++place;
    }
  }
  void step(const rtl::Word* inputs, bool reset) override {
    native_.step(inputs, reset);
    verilog_.step(inputs, reset);
    started_ = true;
    ++cycle_;
  }
  void state(rtl::Word*) const override {}

  std::string first_difference;

 private:
  const rtl::Core& core_;
  NativeCore native_;
  VerilatedMachine verilog_;
  std::vector<rtl::Word> other_;
  bool started_ = false;
  int cycle_ = 0;
};

}  // namespace hitpipe::sim::core_pictures
