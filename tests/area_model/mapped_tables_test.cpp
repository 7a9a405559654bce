// Tables and registers of graphs small enough to map by hand.
#include "area_model/mapped_tables.hpp"

#include <string>

#include <gtest/gtest.h>

#include "area_model/mapped_registers.hpp"
#include "area_model/price.hpp"
#include "rtl_gen/catalogue/design.hpp"
#include "tests/rtl_gen/component/unit_library.hpp"

namespace hitpipe::area::mapped_tables_test {
namespace {

using rtl::Graph;
using rtl::NodeId;
using rtl::Op;

constexpr int table_inputs = 6, shortest = 3;

rtl::Chip chip() {
  rtl::Chip chip;
  chip.lut_inputs = table_inputs;
  chip.maps_tables = true;
  chip.carry_takes_logic = true;
  chip.shortest_shift_register = shortest;
  return chip;
}

/// Its tables take nothing before an adder, and must invert a subtrahend.
rtl::Chip plain_chip() {
  rtl::Chip plain = chip();
  plain.carry_takes_logic = false;
  plain.subtrahend_delay_ps = 1;
  return plain;
}

rtl::ChipCells mapped(const Graph& graph, int stages = 1, const rtl::Chip& on = chip()) {
  const rtl::Schedule schedule = schedule_as_stated(graph, stages);
  rtl::ChipCells all;
  for (const auto& [part, cells] :
       mapped_cells(graph, {schedule, {}}, place_registers(graph, schedule, rtl::Ports::latched), on))
    all += cells;
  return all;
}

struct Three {
  Graph graph{"toy"};
  NodeId a = graph.input("a", 9, false), b = graph.input("b", 9, false), c = graph.input("c", 9, false);

  [[nodiscard]] std::int64_t tables(NodeId made, const rtl::Chip& on = chip()) {
    graph.output("made", made);
    return mapped(graph, 1, on).luts;
  }
};

TEST(MappedTables, AnAdderTakesTheLogicBeforeItsSecondOperand) {
  Three plain, second, first;
  EXPECT_EQ(plain.tables(plain.graph.binary(Op::add, plain.a, plain.b)), 9);
  Graph& g = second.graph;
  EXPECT_EQ(second.tables(g.binary(Op::sub, second.a, g.binary(Op::bit_xor, second.b, second.c))), 9);
  Graph& f = first.graph;
  EXPECT_EQ(first.tables(f.binary(Op::sub, f.binary(Op::bit_xor, first.b, first.c), first.a)), 18)
      << "the carry chain reads the first operand by itself";
}

TEST(MappedTables, ASubtrahendIsInvertedUnlessATableMakesIt) {
  Three sum, difference, made, less;
  EXPECT_EQ(sum.tables(sum.graph.binary(Op::add, sum.a, sum.b), plain_chip()), 9);
  Graph& d = difference.graph;
  EXPECT_EQ(difference.tables(d.binary(Op::sub, difference.a, difference.b), plain_chip()), 18);
  Graph& m = made.graph;
  EXPECT_EQ(made.tables(m.binary(Op::sub, made.a, m.binary(Op::bit_xor, made.b, made.c)), plain_chip()), 18);
  EXPECT_EQ(less.tables(less.graph.binary(Op::less, less.a, less.b), plain_chip()), 9)
      << "the chain has no sum";
}

TEST(MappedTables, LowZerosOfASumAreNoTables) {
  Three x;
  Graph& g = x.graph;
  const NodeId shifted = g.concat(g.slice(x.b, 4, 0), g.constant(4, 0));
  EXPECT_EQ(x.tables(g.binary(Op::add, x.a, shifted)), 5);
}

TEST(MappedTables, AComparatorIsTwoTablesForThreeBits) {
  Three x, sign, narrow;
  EXPECT_EQ(x.tables(x.graph.binary(Op::less, x.a, x.b, true)), 6);
  EXPECT_EQ(sign.tables(sign.graph.binary(Op::less, sign.a, sign.graph.constant(9, 0), true)), 0);
  Graph& g = narrow.graph;
  EXPECT_EQ(narrow.tables(g.binary(Op::less, g.slice(narrow.a, 2, 0), g.slice(narrow.b, 2, 0))), 1);
}

TEST(MappedTables, MultiplexersLieTogether) {
  Three x;
  Graph& g = x.graph;
  const auto bit = [&](int i) { return g.slice(x.c, i, i); };
  const NodeId one = g.mux(bit(0), x.a, x.b);
  EXPECT_EQ(x.tables(g.mux(bit(1), one, g.mux(bit(0), x.b, g.invert(x.a)))), 9);
}

/// a waits in the registers 0 to 3, and b is read in each stage.
TEST(MappedRegisters, ABitThatOnlyWaitsIsAShiftRegister) {
  const auto waits = [](int stages) {
    Graph g("toy");
    const NodeId a = g.input("a", 9, false);
    const NodeId b = g.input("b", 9, false);
    NodeId sum = g.input("c", 9, false);
    for (int stage = 1; stage < stages; ++stage) {
      g.begin_stage(stage);
      sum = g.binary(Op::add, sum, b);
    }
    g.begin_stage(stages);
    g.output("sum", g.binary(Op::bit_and, sum, a));
    return mapped(g, stages);
  };
  EXPECT_EQ(waits(2), (rtl::ChipCells{9 + 9, 9 * (3 + 2 + 1), 0})) << "two registers in a row stay";
  EXPECT_EQ(waits(4), (rtl::ChipCells{3 * 9 + 9 + 9, 9 * (3 + 1 + 3 + 1), 0}));
}

TEST(MappedRegisters, TagsAreShiftRegistersToo) {
  const rtl::Design& design = rtl::find_design("int_slabs");
  const rtl::Pipeline p = make_pipeline(design.trace(design.parse_format("8/8")), rtl::library_called("xc7"));
  rtl::ChipCells tags;
  for (const auto& [part, cells] : mapped_tags(p, chip())) tags += cells;
  EXPECT_EQ(tags, (rtl::ChipCells{tag_bits, 0, 0}));
  tags = {};
  rtl::Chip without = chip();
  without.shortest_shift_register = 0;
  for (const auto& [part, cells] : mapped_tags(p, without)) tags += cells;
  EXPECT_EQ(tags, (rtl::ChipCells{0, tag_bits * (p.schedule.stages + 1), 0}));
}

/// What Yosys 0.23 maps (`hitpipe implement int_slabs --target xc7`; docs/measured/chips.md).
TEST(MappedTables, OfIntSlabsAreWhatYosysMakes) {
  const rtl::Design& design = rtl::find_design("int_slabs");
  const rtl::Library xc7 = rtl::library_called("xc7");
  const auto format = design.parse_format("16/16");
  const Price of = price(make_pipeline(design.trace(format), xc7), design, format, xc7);
  EXPECT_EQ(of.taken, (rtl::ChipCells{458, 707, 6}));
  rtl::ChipCells stages;
  for (const StagePrice& stage : of.by_stage) stages += stage.taken;
  EXPECT_EQ(stages, of.taken);
}

}  // namespace
}  // namespace hitpipe::area::mapped_tables_test
