// A design of hardware alone, without any set-up of rays and boxes: simulation, Verilog, schematic, price and
// the check of the Verilog come with its one file.
#include "tests/foreign_design/one_axis_slab.hpp"

#include <array>
#include <cstdint>

#include <gtest/gtest.h>

#include "area_model/price.hpp"
#include "host/files.hpp"
#include "rtl_gen/catalogue/design_of.hpp"
#include "rtl_gen/emit/unit_folder.hpp"
#include "rtl_gen/emit/vectors.hpp"
#include "rtl_gen/pipeline.hpp"
#include "sim/unit/verilated_design.hpp"
#include "tests/rtl_gen/tool.hpp"

namespace hitpipe {
namespace {

constexpr hls::IntBits bits{24, 24};

const rtl::Design slab = rtl::design_of<hls::OneAxisSlab>();

TEST(OneAxisSlab, RunsOnTheHost) {
  const rtl::Evaluate hit = slab.evaluate(bits);
  const std::int64_t middle = std::int64_t{1} << 22;
  const auto meets = [&](std::int64_t plane, std::int64_t length, bool from_above) {
    const std::array<std::int64_t, 6> operands{
        0, middle, from_above ? 0 : plane, from_above ? plane : 0, length, from_above ? 1 : 0};
    return hit(operands.data());
  };
  // t = plane * 2^22 / 2^23: half the plane's coordinate.
  EXPECT_TRUE(meets(1000, 500, false));
  EXPECT_FALSE(meets(1002, 500, false));
  EXPECT_TRUE(meets(1000, 500, true));
  EXPECT_FALSE(meets(-2, 500, false));
}

TEST(OneAxisSlab, IsScheduledAndPriced) {
  const area::Price price = area::price(slab, bits, rtl::Library::thesis(), area::Account::built);
  EXPECT_EQ(price.stages, 5);
  EXPECT_EQ(price.stage_delay_ps, 3176);
  const auto count = [&](const std::string& name) {
    for (const area::Line& line : price.lines) {
      if (area::part_name(line.part) == name) return line.n;
    }
    return 0;
  };
  EXPECT_EQ(count("int_multiply_24"), 1);
  EXPECT_EQ(count("int_subtract_24"), 1);
  EXPECT_EQ(count("int_compare_24"), 1);
  EXPECT_EQ(count("mux2_24"), 1);
  EXPECT_GT(price.area_um2, 134324 + 13677 + 5439 + 730);
}

TEST(OneAxisSlab, IsEmittedDrawnAndLintClean) {
  const host::ScratchFolder folder;
  const rtl::EmittedDesign emitted =
      rtl::emit(rtl::make_unit(slab, bits, rtl::Library::thesis(), {.module = "one_axis_slab"}));
  EXPECT_TRUE(rtl::write_unit(folder.path(), emitted).drawn);
  EXPECT_FALSE(emitted.schematics.empty());
  const rtl::ToolResult lint =
      rtl::run_tool(folder.path(), "verilator", "verilator", "--lint-only -Wall one_axis_slab.v");
  EXPECT_EQ(lint.status, 0);
  EXPECT_EQ(lint.output, "");
  const rtl::ToolResult replay =
      rtl::run_tool(folder.path(), "iverilog", "iverilog",
                    "-g2012 -Wall -o run tb/one_axis_slab_tb.sv one_axis_slab.v && cd tb && vvp ../run");
  EXPECT_NE(replay.output.find("PASS 1000 vectors"), std::string::npos) << replay.output;
}

TEST(OneAxisSlab, AnswersInVerilogAsInCpp) {
  constexpr int count = 100000;
  const host::ScratchFolder cache;
  const sim::VerilatedDesign verilated(rtl::make_unit(slab, bits, rtl::Library::thesis()), cache.path());
  const rtl::Evaluate evaluate = slab.evaluate(bits);
  const auto vectors = rtl::operand_vectors(slab.ports(bits), count, 5);
  sim::Model model(verilated);
  std::size_t received = 0;
  std::size_t hits = 0;
  for (std::size_t cycle = 0; cycle < vectors.size() + 10; ++cycle) {
    const bool sending = cycle < vectors.size();
    sim::Pins pins{.in_valid = sending, .in_tag = static_cast<std::uint16_t>(cycle)};
    model.cycle(sending ? vectors[cycle].data() : nullptr, pins);
    if (!pins.out_valid) continue;
    ASSERT_LT(received, vectors.size());
    ASSERT_EQ(pins.hit, evaluate(vectors[received].data())) << "vector " << received;
    ASSERT_EQ(pins.out_tag, static_cast<std::uint16_t>(received));
    hits += pins.hit ? 1 : 0;
    ++received;
  }
  EXPECT_EQ(received, vectors.size());
  EXPECT_GT(hits, vectors.size() / 50);
  EXPECT_LT(hits, vectors.size() - vectors.size() / 50);
}

}  // namespace
}  // namespace hitpipe
