// Counts of components, on graphs small enough to count by hand, and each departure of Table 7.2 by itself.
#include "area_model/count.hpp"

#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "area_model/price.hpp"
#include "rtl_gen/catalogue/design.hpp"
#include "tests/message_of.hpp"
#include "tests/rtl_gen/component/unit_library.hpp"

namespace hitpipe::area::count_test {
namespace {

using rtl::Graph;
using rtl::NodeId;
using rtl::Op;
using rtl::unit_library;

/// "stage 0: latch_8 x 2", one line for each component.
std::vector<std::string> lines_of(const std::vector<Count>& counts) {
  std::vector<std::string> lines;
  for (const Count& c : counts) lines.push_back(fmt::format("{}: {} x {}", c.stage, part_name(c.part), c.n));
  return lines;
}

int total(const std::vector<Count>& counts, const std::string& name) {
  int n = 0;
  for (const Count& c : counts) n += part_name(c.part) == name ? c.n : 0;
  return n;
}

std::pair<NodeId, NodeId> two_inputs(Graph& g) {
  const NodeId a = g.input("a", 8, true);
  return {a, g.input("b", 8, true)};
}

// a - b, then the smaller of it and c: two stages of the unit library.
Graph smaller_of_difference() {
  Graph g("toy");
  const auto [a, b] = two_inputs(g);
  const NodeId c = g.input("c", 8, true);
  const NodeId difference = g.binary(Op::sub, a, b);
  g.output("smaller", g.mux(g.binary(Op::less, difference, c, true), difference, c));
  return g;
}

int packed_in(const Graph& graph, std::optional<int> clock_ps = {}) {
  const rtl::Pipeline p = make_pipeline(graph, unit_library(), clock_ps);
  return packed_bits(p.graph, {p.schedule, p.binding}, p.placement);
}

/// A register shares a cell with the table before it: not an input's, not one that only passes a value on,
/// and not behind a table that something else reads.
TEST(PackedBits, AreThoseBehindTheirOwnTables) {
  // The difference is latched behind its tables (8), and so is the smaller value (8). c waits in two
  // registers.
  EXPECT_EQ(packed_in(smaller_of_difference()), 16);
  Graph read_twice("toy");
  const auto [a, b] = two_inputs(read_twice);
  const NodeId both = read_twice.binary(Op::bit_and, a, b);
  read_twice.output("both", both);
  read_twice.output("other", read_twice.binary(Op::bit_xor, both, b));
  EXPECT_EQ(packed_in(read_twice), 16) << "the second gate has a stage of its own";
  EXPECT_EQ(packed_in(read_twice, 1000), 8) << "it reads the first one in the same stage";
}

TEST(PackedBits, MakeLogicCellsOfTablesAndRegisters) {
  const rtl::Design& design = rtl::find_design("int_slabs");
  const rtl::Library up5k = rtl::library_called("ice40_up5k");
  const rtl::Pipeline p = make_pipeline(design.trace(design.parse_format("8/8")), up5k);
  const Price of = price(p, design, design.parse_format("8/8"), up5k);
  ASSERT_TRUE(of.logic_cells);
  EXPECT_EQ(*of.logic_cells,
            of.taken.luts + of.taken.registers - packed_bits(p.graph, {p.schedule, p.binding}, p.placement));
  EXPECT_LT(*of.logic_cells, of.taken.luts + of.taken.registers);
  const rtl::Library xc7 = rtl::library_called("xc7");
  EXPECT_FALSE(price(make_pipeline(design.trace(design.parse_format("8/8")), xc7), design,
                     design.parse_format("8/8"), xc7)
                   .logic_cells);
}

TEST(CountBuilt, CountsEveryRegisterAndComponentWithValidAndTag) {
  EXPECT_EQ(lines_of(count_built(make_pipeline(smaller_of_difference(), unit_library()))),
            (std::vector<std::string>{"0: latch_8 x 3", "0: valid_1 x 1", "0: tag_16 x 1",  //
                                      "1: int_subtract_8 x 1", "1: latch_8 x 2", "1: valid_1 x 1",
                                      "1: tag_16 x 1",  //
                                      "2: int_compare_8 x 1", "2: latch_8 x 1", "2: mux2_8 x 1",
                                      "2: valid_1 x 1", "2: tag_16 x 1"}));
}

TEST(CountPrinted, LeavesOutValidAndTagAndTheInputLatchesIfToldSo) {
  const rtl::Pipeline pipeline = make_pipeline(smaller_of_difference(), unit_library());
  rtl::ThesisAccounting accounting{.rows = {}, .input_latches = true};
  EXPECT_EQ(lines_of(count_printed(pipeline, hls::IntBits{8, 8}, accounting)),
            (std::vector<std::string>{"0: latch_8 x 3",                           //
                                      "1: int_subtract_8 x 1", "1: latch_8 x 2",  //
                                      "2: int_compare_8 x 1", "2: latch_8 x 1", "2: mux2_8 x 1"}));
  accounting.input_latches = false;
  EXPECT_EQ(total(count_printed(pipeline, hls::IntBits{8, 8}, accounting), "latch_8"), 3);
}

int comparators(const Graph& graph) {
  return total(count_built(make_pipeline(graph, unit_library())), "int_compare_8");
}

TEST(Comparator, GivesBothOrdersOfOnePair) {
  Graph g("toy");
  const auto [a, b] = two_inputs(g);
  g.output("less", g.binary(Op::less, a, b, true));
  g.output("greater", g.binary(Op::less, b, a, true));
  EXPECT_EQ(comparators(g), 1);
  g.output("unsigned_less", g.binary(Op::less, a, b, false));
  EXPECT_EQ(comparators(g), 2);
  g.output("less_than_zero", g.binary(Op::less, a, g.constant(8, 0), true));
  EXPECT_EQ(comparators(g), 3);
}

TEST(Comparator, IsNotSharedByStages) {
  Graph g("toy");
  const auto [a, b] = two_inputs(g);
  g.output("less", g.binary(Op::less, a, b, true));
  g.begin_stage(2);
  g.output("greater", g.binary(Op::less, b, a, true));
  rtl::Pipeline p{g, schedule_as_stated(g, 2), {}};
  EXPECT_EQ(lines_of(count_printed(p, hls::IntBits{8, 8}, {.rows = {}, .input_latches = true})),
            (std::vector<std::string>{"1: int_compare_8 x 1", "2: int_compare_8 x 1"}));
}

// With n = t + 1, side relations and differences of coordinates are equally wide. Only side relations are
// priced at t.
TEST(PrintedWidths, SideRelationsAreKnownByTheirMultipliers) {
  Graph g("toy");
  const NodeId a = g.input("a", 9, true);
  const NodeId b = g.input("b", 9, true);
  const NodeId plane = g.binary(Op::sub, a, b);
  const auto term = [&](NodeId x, NodeId y) {
    return g.extend(g.slice(g.binary(Op::mul, x, y, true), 16, 9), 9, true);
  };
  const NodeId side = g.binary(Op::sub, term(plane, a), term(plane, b));
  const NodeId outside = g.binary(Op::less, side, g.constant(9, 511), true);
  const NodeId ahead = g.binary(Op::less, a, b, true);
  const rtl::ThesisAccounting sides{.rows = {}, .side_relations_at_t = true};
  for (const auto& [node, bits] : {std::pair{side, 8}, {outside, 8}, {plane, 9}, {ahead, 9}}) {
    EXPECT_EQ(printed_component_bits(g, node, hls::IntBits{9, 8}, sides), bits);
    EXPECT_EQ(printed_component_bits(g, node, hls::IntBits{9, 8}, {}), 9);
  }
}

TEST(PrintedWidths, ProductLatchesHaveNoMoreThanNBits) {
  Graph g("toy");
  const NodeId a = g.input("a", 8, true);
  const NodeId product = g.binary(Op::mul, a, a, true);
  const rtl::ThesisAccounting narrow{.rows = {}, .input_latches = true, .products_at_n_bits = true};
  const rtl::Register of_product{product, 3, 14, 3};
  EXPECT_EQ(printed_latch_bits(g, of_product, hls::IntBits{8, 12}, narrow), 8);
  EXPECT_EQ(printed_latch_bits(g, of_product, hls::IntBits{8, 12}, {.rows = {}, .input_latches = true}), 12);
  EXPECT_EQ(printed_latch_bits(g, {product, 3, 14, 9}, hls::IntBits{8, 6}, narrow), 6);
  EXPECT_EQ(printed_latch_bits(g, {a, 0, 7, 0}, hls::IntBits{6, 12}, narrow), 8);
}

TEST(PrintedAccount, IsOfTheFourDesignsOfTheThesis) {
  rtl::Design mine = rtl::find_design("int_slabs");
  mine.name = "fixed_slabs";
  mine.printed = {};
  EXPECT_EQ(
      message_of([&] { return price(mine, mine.default_format, rtl::Library::thesis(), Account::printed); }),
      "design fixed_slabs: not in Table 7.2, so there is no printed account of it, only the built one");
}

TEST(PartName, IsTableSevenOnesWithTheWidth) {
  EXPECT_EQ(part_name({rtl::Component::latch, 24}), "latch_24");
  EXPECT_EQ(part_name({rtl::Component::fp_multiply, 32}), "fp_multiply_32");
  EXPECT_EQ(part_name({rtl::Component::latch, 1, Purpose::valid}), "valid_1");
  EXPECT_EQ(part_name({rtl::Component::latch, 16, Purpose::tag}), "tag_16");
  EXPECT_EQ(part_name({rtl::Component::int_multiply, 24, Purpose::datapath, 18}), "int_multiply_24x18");
}

}  // namespace
}  // namespace hitpipe::area::count_test
