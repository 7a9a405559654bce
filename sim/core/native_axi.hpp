// A core behind AXI (rtl_gen/core/axi.hpp) as software, cycle by cycle: the same parts and joints as its Verilog.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "rtl_gen/core/core.hpp"
#include "rtl_gen/machine/machine.hpp"
#include "rtl_gen/part/assembly.hpp"
#include "sim/core/native_core.hpp"

namespace hitpipe::sim {

/// A number of any width: words of 64 bits, the lowest first. Bits above its width are 0.
using PinWords = std::vector<std::uint64_t>;

class NativeAxi {
 public:
  explicit NativeAxi(const rtl::Core& core);

  /// Its pins are those of the module, in their order. The clock is step().
  [[nodiscard]] const rtl::ModuleInterface& interface() const { return of_.interface; }
  /// Of an input, for this cycle.
  void set(std::size_t pin, const PinWords& words);
  /// Of an output, by the inputs as they are now.
  [[nodiscard]] const PinWords& get(std::size_t pin);
  /// The clock edge.
  void step();

 private:
  [[nodiscard]] PinWords& at(std::size_t part, std::size_t pin) {
    return part == rtl::PinBits::outside ? outside_[pin] : inside_[part][pin];
  }
  [[nodiscard]] std::uint64_t bits(const rtl::PinBits& bits);
  [[nodiscard]] bool lets_through(const rtl::Gate& gate);
  void drive(const rtl::Joint& joint);
  /// All outputs and all inputs of parts.
  void settle();

  rtl::Assembly of_;
  NativeCore core_;
  std::vector<std::unique_ptr<rtl::JoinedMachine>> machines_;  ///< by part; null: the core
  std::vector<PinWords> outside_;
  std::vector<std::vector<PinWords>> inside_;
  bool settled_ = false;
};

}  // namespace hitpipe::sim
