// The registers that Yosys finds in the Verilog are exactly the registers that the schedule placed.
#include <regex>

#include <gtest/gtest.h>

#include "rtl_gen/component/product.hpp"
#include "rtl_gen/schedule/divided_unit.hpp"
#include "rtl_gen/verilog/module.hpp"
#include "rtl_gen/verilog/names.hpp"
#include "tests/rtl_gen/catalogue/formats.hpp"
#include "tests/rtl_gen/tool.hpp"

namespace hitpipe::rtl::register_bits_test {
namespace {

constexpr int tag_bits = 16;

int bits_of(const Placement& placement) {
  int bits = 0;
  for (const Register& r : placement.registers) bits += r.width();
  return bits;
}

int bits_inside(const Graph& component, const Schedule& schedule) {
  return bits_of(place_registers(component, schedule, Ports::direct));
}

/// Inside a pipelined multiplier or unit; 0 for anything else.
int component_bits(const Pipeline& p, NodeId id) {
  const Node& n = p.graph[id];
  const Slot& slot = p.schedule.slots[id];
  if (n.op == Op::call) {
    const Graph& body = p.graph.submodule_of(id)->body;
    return bits_inside(body, balance(body, slot.finish - slot.stage + 1));
  }
  if (n.op != Op::mul || !slot.latched) return 0;
  const BitSpan used = used_span(p.graph, p.placement, id);
  const MultiplierShape shape{.width_a = p.graph[n.args[0]].width,
                              .width_b = p.graph[n.args[1]].width,
                              .is_signed = n.is_signed,
                              .stages = slot.finish - slot.stage + 1,
                              .high = used.high,
                              .low = used.low};
  const Graph inside = multiplier(shape, "mul");
  return bits_inside(inside, schedule_as_stated(inside, shape.stages));
}

/// Latches between the values, inside the components, and beside them: a valid bit and a tag at each
/// boundary.
int placed_bits(const Pipeline& p) {
  int bits = bits_of(p.placement) + (p.schedule.stages + 1) * (1 + tag_bits);
  for (NodeId id = 0; id < p.graph.size(); ++id) bits += component_bits(p, id);
  return bits;
}

struct Flops {
  int bits = 0;
  int of_24_bits = 0;  ///< words
};

/// Flip-flops of the flattened design, before Yosys optimises.
Flops found_by_yosys(const Pipeline& pipeline) {
  const ScratchFolder folder;
  write_text(folder / "design.v", to_verilog(pipeline, Library::thesis()));
  const ToolResult yosys =
      run_tool(folder.path(), "yosys", "yosys",
               "-p 'read_verilog design.v; hierarchy -check -top " + pipeline.graph.name() +
                   "; proc; flatten; tee -o stat.txt stat -width'");
  EXPECT_EQ(yosys.status, 0) << yosys.output;
  const std::string stat = read_text(folder / "stat.txt");
  const std::regex flop("\\$[a-z]*dff[a-z]*_([0-9]+) +([0-9]+)");
  Flops flops;
  for (std::sregex_iterator at(stat.begin(), stat.end(), flop); at != std::sregex_iterator(); ++at) {
    const int width = std::stoi((*at)[1]);
    const int count = std::stoi((*at)[2]);
    flops.bits += width * count;
    if (width == 24) flops.of_24_bits += count;
  }
  return flops;
}

class RegisterBits : public testing::TestWithParam<DesignFormat> {};

TEST_P(RegisterBits, AreThePlacedOnes) {
  const Pipeline pipeline = GetParam().pipeline();
  EXPECT_EQ(found_by_yosys(pipeline).bits, placed_bits(pipeline));
}

INSTANTIATE_TEST_SUITE_P(Designs, RegisterBits,
                         testing::ValuesIn(every_design({"24/24", "20/24", "6/11", "32/63"})), design_suffix);

TEST(RegisterWords, AreTheThesiss38Of24Bits) {
  EXPECT_EQ(found_by_yosys(int_slabs_pipeline({24, 24})).of_24_bits, 38) << "Table 7.2, Int 24/24 Slabs-AABB";
}

}  // namespace
}  // namespace hitpipe::rtl::register_bits_test
