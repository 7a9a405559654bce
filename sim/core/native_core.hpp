// A core (rtl_gen/core) as software, cycle by cycle: its machines as C++, its units as their own C++ behind
// as many cycles as their pipelines have stages, joined by the core's wires.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "rtl_gen/core/core.hpp"
#include "rtl_gen/machine/machine.hpp"

namespace hitpipe::sim {

namespace core_parts {
class Part;
}

/// Its inputs and outputs are the core's ports, in their order. It shows no registers.
class NativeCore final : public rtl::NativeMachine {
 public:
  explicit NativeCore(const rtl::Core& core, rtl::Collision collision = rtl::Collision::old_word);
  ~NativeCore() override;
  NativeCore& operator=(const NativeCore&) = delete;

  void outputs(rtl::Word* outputs) override;
  void step(const rtl::Word* inputs, bool reset) override;
  void state(rtl::Word* /*registers*/) const override {}

 private:
  NativeCore(const NativeCore&) = delete;
  /// Gives all outputs.
  void settle();

  std::vector<std::unique_ptr<core_parts::Part>> parts_;
  std::vector<std::uint64_t> inputs_;  ///< of the core
  std::vector<const std::uint64_t*> outputs_;
  bool settled_ = false;  ///< the outputs are this cycle's
};

}  // namespace hitpipe::sim
