// A core (rtl_gen/core) as software, cycle by cycle: its machines as C++, its units as their own C++ behind
// as many cycles as their pipelines have stages, joined by the core's wires.
#pragma once

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
  /// Gives all outputs, and takes them to the inputs that wires lead to.
  void settle();

  struct Copy {
    const rtl::Word* from;
    rtl::Word* to;
  };

  std::vector<std::unique_ptr<core_parts::Part>> parts_;
  std::vector<Copy> wires_;
  std::vector<std::vector<rtl::Word*>> inputs_;  ///< by input of the core: where it goes
  std::vector<const rtl::Word*> outputs_;
  bool settled_ = false;  ///< the wires have this cycle's values
};

}  // namespace hitpipe::sim
