// The emitted Verilog of the narrow units gives the answers of the C++ for every operand tuple of the sweeps
// `endless` and `ended`: all rays with different operands against all boxes with different operands.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "sim/unit/verilated_design.hpp"
#include "tests/exhaustive/narrow_unit.hpp"
#include "tests/exhaustive/sweep.hpp"

namespace hitpipe::ref::exhaustive {
namespace {

std::string hex(const Operands& operands, std::size_t count) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) {
    char word[24];
    std::snprintf(word, sizeof word, " %s0x%llx", operands[i] < 0 ? "-" : "",
                  static_cast<unsigned long long>(std::abs(operands[i])));
    text += word;
  }
  return text;
}

std::vector<Operands> distinct_rays(const NarrowUnit& unit) {
  std::set<Operands> found;
  for (const Sweep& sweep : {endless, ended}) {
    for (const Ray& ray : sweep.rays()) {
      Operands operands{};
      unit.set_up(ray, unit.format, operands.data());
      found.insert(operands);
    }
  }
  return {found.begin(), found.end()};
}

std::vector<IntBox> distinct_boxes(const NarrowUnit& unit) {
  std::vector<IntBox> found;
  for (const Aabb& box : boxes(endless.corners)) {
    const IntBox rounded = narrow_box(box, unit.coord, unit.finer);
    if (std::find(found.begin(), found.end(), rounded) == found.end()) found.push_back(rounded);
  }
  return found;
}

/// Sends everything back to back and compares each answer in turn with the C++.
void expect_same_answers(const NarrowUnit& unit) {
  const sim::VerilatedDesign verilated(rtl::make_unit(unit.design, unit.format, rtl::Library::thesis()));
  ASSERT_EQ(verilated.operand_count(), unit.ray_operands + 6);
  const std::vector<Operands> rays = distinct_rays(unit);
  const std::vector<IntBox> all_boxes = distinct_boxes(unit);
  const std::size_t count = rays.size() * all_boxes.size();
  const auto vector_at = [&](std::size_t i) {
    Operands operands = rays[i / all_boxes.size()];
    put_box(all_boxes[i % all_boxes.size()], operands.data() + unit.ray_operands);
    return operands;
  };
  sim::Model model(verilated);
  std::size_t received = 0;
  std::size_t hits = 0;
  const auto latency = static_cast<std::size_t>(verilated.latency());
  for (std::size_t cycle = 0; cycle < count + latency + 2; ++cycle) {
    const bool sending = cycle < count;
    const Operands operands = vector_at(sending ? cycle : 0);
    sim::Pins pins{.in_valid = sending, .in_tag = static_cast<std::uint16_t>(cycle)};
    model.cycle(operands.data(), pins);
    ASSERT_TRUE(pins.in_ready);
    if (!pins.out_valid) continue;
    ASSERT_LT(received, count);
    const Operands asked = vector_at(received);
    ASSERT_EQ(pins.hit, unit.evaluate(asked.data())) << hex(asked, unit.ray_operands + 6);
    ASSERT_EQ(pins.out_tag, static_cast<std::uint16_t>(received));
    hits += pins.hit ? 1 : 0;
    ++received;
  }
  std::printf("%zu rays x %zu boxes = %zu vectors, %zu hits\n", rays.size(), all_boxes.size(), count, hits);
  EXPECT_EQ(received, count);
  EXPECT_EQ(all_boxes.size(), 1000U);
  EXPECT_GT(rays.size(), 5000U);
  EXPECT_GT(hits, count / 20);
  EXPECT_LT(hits, count - count / 20);
}

class EveryOperandTuple : public testing::TestWithParam<NarrowUnit> {};

TEST_P(EveryOperandTuple, IsAnsweredInVerilogAsInCpp) {
  expect_same_answers(GetParam());
}

std::string name_of(const testing::TestParamInfo<NarrowUnit>& unit) {
  return testing::PrintToString(unit.param);
}

/// Both designs with all bits of a product kept.
std::vector<NarrowUnit> widest_of(const std::vector<NarrowUnit>& units) {
  return {units[units.size() - 2], units.back()};
}

/// With most bits dropped, and with none.
std::vector<NarrowUnit> ends_of(const std::vector<NarrowUnit>& units) {
  std::vector<NarrowUnit> ends = widest_of(units);
  ends.insert(ends.begin(), {units[0], units[1]});
  return ends;
}

/// 4+1/3: its origin is finer than its planes.
std::vector<NarrowUnit> finer_major() {
  return {major_units()[2]};
}

INSTANTIATE_TEST_SUITE_P(MajorAxis, EveryOperandTuple, testing::ValuesIn(finer_major()), name_of);
INSTANTIATE_TEST_SUITE_P(FourBits, EveryOperandTuple, testing::ValuesIn(ends_of(units(4))), name_of);
INSTANTIATE_TEST_SUITE_P(FiveBits, EveryOperandTuple, testing::ValuesIn(widest_of(units(5))), name_of);

}  // namespace
}  // namespace hitpipe::ref::exhaustive
