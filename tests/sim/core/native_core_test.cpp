// The software of a core does not depend on the order in which its parts step.
#include "sim/core/native_core.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "rtl_gen/component/library.hpp"
#include "sim/core/core_vectors.hpp"

namespace hitpipe::sim::native_core_test {
namespace {

/// The same core with its parts in reverse order.
rtl::Core reversed(rtl::Core core) {
  const auto other = [&](std::size_t part) { return core.parts.size() - 1 - part; };
  std::reverse(core.parts.begin(), core.parts.end());
  for (rtl::CoreWire& wire : core.wires) {
    wire.from = other(wire.from);
    wire.to = other(wire.to);
  }
  for (rtl::CorePort& port : core.ports)
    for (rtl::CorePort::End& end : port.ends) end.part = other(end.part);
  return core;
}

TEST(NativeCore, TheOrderOfItsPartsDoesNotMatter) {
  const rtl::Core core = rtl::make_core({.bits = {12, 1, 7, 0, 12, 0}, .rays = 12, .stack_bits = 1},
                                        rtl::library_called(rtl::default_library));
  const std::vector<rtl::MachineCycle> one = core_test(core, 5'000, 3).cycles;
  const std::vector<rtl::MachineCycle> other = core_test(reversed(core), 5'000, 3).cycles;
  ASSERT_EQ(one.size(), 5'000U);
  ASSERT_EQ(one.size(), other.size());
  std::size_t answers = 0;
  const auto hit_valid = std::find_if(core.ports.begin(), core.ports.end(),
                                      [](const rtl::CorePort& port) { return port.pin.name == "hit_valid"; });
  const auto place = static_cast<std::size_t>(std::count_if(
      core.ports.begin(), hit_valid, [](const rtl::CorePort& port) { return !port.pin.is_input; }));
  for (std::size_t i = 0; i < one.size(); ++i) {
    ASSERT_EQ(one[i].inputs, other[i].inputs) << "cycle " << i;
    ASSERT_EQ(one[i].outputs, other[i].outputs) << "cycle " << i;
    answers += one[i].outputs[place] != 0 ? 1 : 0;
  }
  EXPECT_GT(answers, 50U);
}

}  // namespace
}  // namespace hitpipe::sim::native_core_test
