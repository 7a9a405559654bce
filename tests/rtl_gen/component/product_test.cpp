// Products on a chip: every plan gives the product, and takes no more blocks than it may. The divided
// multiplier gives every product of small widths, and has its stated stages.
#include "rtl_gen/component/product.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "hls/num/bits.hpp"
#include "rtl_gen/component/library.hpp"
#include "rtl_gen/graph/canonical.hpp"
#include "rtl_gen/schedule/registers.hpp"
#include "tests/rtl_gen/seeded.hpp"

namespace hitpipe::rtl::product_test {
namespace {

std::uint64_t extended(std::uint64_t value, int width, bool is_signed) {
  return is_signed ? static_cast<std::uint64_t>(hls::sign_extended(value, width)) : value;
}

std::uint64_t true_product(const ProductShape& s, std::uint64_t a, std::uint64_t b) {
  return extended(a, s.width_a, s.a_signed) * extended(b, s.width_b, s.b_signed) & hls::low_mask(s.width());
}

std::string sized(const ProductShape& s) {
  return fmt::format("{}{} x {}{}", s.width_a, s.a_signed ? "s" : "u", s.width_b, s.b_signed ? "s" : "u");
}

Chip chip_with(int width_a, int width_b, bool reads_unsigned, int luts) {
  Chip chip;
  chip.gate_luts_pct = chip.mux_luts_pct = chip.carry_luts_pct = 100;
  if (width_a > 0) {
    chip.block = Block{
        .name = "B", .width_a = width_a, .width_b = width_b, .reads_unsigned = reads_unsigned, .luts = luts};
  }
  return chip;
}

Graph made(const ProductShape& s, const ProductPlan& plan) {
  Graph g("product");
  const NodeId a = g.input("a", s.width_a, s.a_signed);
  const NodeId b = g.input("b", s.width_b, s.b_signed);
  g.output("p", record_product(g, plan, s, a, b));
  return canonical(g);
}

/// The multiplications of a graph; each must fit the block.
int multiplications(const Graph& g, const Chip& chip) {
  int n = 0;
  for (NodeId id = 0; id < g.size(); ++id) {
    if (g[id].op != Op::mul) continue;
    ++n;
    EXPECT_TRUE(chip.block && chip.block->multiplies(g[g[id].args[0]].width, g[id].is_signed,
                                                     g[g[id].args[1]].width, g[id].is_signed));
  }
  return n;
}

/// A planned product on a chip.
struct Planned {
  Planned(const ProductShape& s, const Chip& chip) : Planned(s, chip, plan_product(s, chip)) {}
  Planned(const ProductShape& s, const Chip& chip, const ProductPlan& plan) : shape(s), graph(made(s, plan)) {
    EXPECT_LE(multiplications(graph, chip), plan.blocks);
  }
  void expect_product(std::uint64_t a, std::uint64_t b) const {
    ASSERT_EQ(evaluate(graph, std::array{a, b}).at(0), true_product(shape, a, b))
        << sized(shape) << std::hex << ", a " << a << ", b " << b;
  }
  ProductShape shape;
  Graph graph;
};

TEST(Product, EveryValueOfSmallWidths) {
  // Chips whose blocks cut small products in every way; where a block is worth nothing, much, or all.
  std::vector<Chip> chips{chip_with(0, 0, false, 0)};
  for (const int luts : {0, 12, 1000})
    for (const bool reads_unsigned : {true, false})
      for (const int width_a : {4, 3}) chips.push_back(chip_with(width_a, 3, reads_unsigned, luts));
  for (const Chip& chip : chips)
    for (int width_a = 1; width_a <= 5; ++width_a)
      for (int width_b = 1; width_b <= 5; ++width_b)
        for (const int signs : {0, 1, 2, 3}) {
          const Planned planned({width_a, width_b, (signs & 1) != 0, (signs & 2) != 0}, chip);
          for (std::uint64_t a = 0; a <= hls::low_mask(width_a); ++a)
            for (std::uint64_t b = 0; b <= hls::low_mask(width_b); ++b)
              ASSERT_NO_FATAL_FAILURE(planned.expect_product(a, b));
        }
}

TEST(Product, RandomValuesOnEveryChip) {
  Seeded random(1122);
  int chips = 0;
  for (const std::string& name : built_in_names()) {
    SCOPED_TRACE(name);
    const Library library = library_called(name);
    if (library.chip() == nullptr) continue;
    ++chips;
    for (int i = 0; i < 60; ++i) {
      const ProductShape s{random.between(1, 32), random.between(1, 32), random.flip(), random.flip()};
      const Planned planned(s, *library.chip());
      for (int v = 0; v < 100; ++v) {
        const std::uint64_t a = random.value(s.width_a);
        ASSERT_NO_FATAL_FAILURE(planned.expect_product(a, random.value(s.width_b)));
      }
    }
  }
  EXPECT_GE(chips, 4);
}

int blocks(const char* library, int width_a, int width_b, bool is_signed = true) {
  return plan_product({width_a, width_b, is_signed, is_signed}, *library_called(library).chip()).blocks;
}

TEST(Product, ThatFitsABlockIsOne) {
  for (const char* const chip : {"xc7", "ecp5", "ice40_up5k"}) {
    for (const int width : {2, 12, 16}) EXPECT_EQ(blocks(chip, width, width), 1) << chip;
    EXPECT_EQ(blocks(chip, 16, 13), 1) << chip;
  }
  EXPECT_EQ(blocks("xc7", 25, 18), 1);
  EXPECT_EQ(blocks("xc7", 18, 25), 1);
  EXPECT_EQ(blocks("xc7", 21, 14), 1);
  EXPECT_EQ(blocks("xc7", 24, 17, false), 1);
  EXPECT_EQ(blocks("ecp5", 18, 18, false), 1);
}

TEST(Product, LargerOnesTakeTheFewestBlocksWithOddBitsInLogic) {
  EXPECT_EQ(blocks("xc7", 20, 20), 1) << "17 bits in the block, 3 in logic";
  EXPECT_EQ(blocks("xc7", 24, 24), 2);
  EXPECT_EQ(blocks("xc7", 24, 24, false), 2) << "the product of two fractions";
  EXPECT_EQ(blocks("ecp5", 20, 20), 1);
  EXPECT_EQ(blocks("ice40_up5k", 20, 20), 1);
  EXPECT_EQ(blocks("ice40_hx", 20, 20), 0);
}

/// A block that multiplies signed operands alone takes unsigned operands of one bit less.
TEST(Block, ReadsUnsignedOperandsWithAZeroAbove) {
  const Block xilinx = *library_called("xc7").chip()->block;
  EXPECT_TRUE(xilinx.multiplies(25, true, 18, true));
  EXPECT_FALSE(xilinx.multiplies(25, true, 18, false));
  EXPECT_TRUE(xilinx.multiplies(25, true, 17, false));
  EXPECT_TRUE(xilinx.multiplies(24, false, 17, false));
  EXPECT_FALSE(xilinx.multiplies(24, false, 18, false));
  const Block lattice = *library_called("ice40_up5k").chip()->block;
  EXPECT_TRUE(lattice.multiplies(16, false, 16, false));
  EXPECT_FALSE(lattice.multiplies(16, true, 16, false));
}

/// a * b by halves of b, without the lowest bits; `low_of_b` and `shift` are half of b's width unless they
/// are wrong on purpose.
Graph by_halves(int width, int low_of_b, int shift) {
  Graph g("by_halves");
  const NodeId a = g.input("a", width, false);
  const NodeId b = g.input("b", width, false);
  const NodeId low = g.binary(Op::mul, a, g.slice(b, low_of_b - 1, 0));
  const NodeId high = g.binary(Op::mul, a, g.slice(b, width - 1, low_of_b));
  const NodeId carried = g.slice(low, g[low].width - 1, shift);
  g.output("p", g.binary(Op::add, high, g.resize(carried, g[high].width, false)));
  return g;
}

TEST(Product, OfTwoHalvesIsOneWhereABlockTakesIt) {
  for (const char* const chip : {"xc7", "ecp5", "ice40_up5k"}) {
    const Library& library = library_called(chip);
    const Graph g = by_halves(16, 8, 8);
    const Graph planned = with_products_planned(g, library);
    EXPECT_EQ(multiplications(planned, *library.chip()), 1) << chip;
    Seeded random(7);
    for (int i = 0; i < 1000; ++i) {
      const std::vector<std::uint64_t> operands{random.value(16), random.value(16)};
      ASSERT_EQ(evaluate(planned, operands), evaluate(g, operands))
          << chip << ' ' << operands[0] << ' ' << operands[1];
    }
  }
}

TEST(Product, OfTwoHalvesStaysSoWhereNoBlockTakesItOrTheShiftIsAnother) {
  const Library& xc7 = library_called("xc7");
  EXPECT_EQ(multiplications(with_products_planned(by_halves(24, 12, 12), xc7), *xc7.chip()), 2);
  EXPECT_EQ(multiplications(with_products_planned(by_halves(16, 8, 7), xc7), *xc7.chip()), 2);
  EXPECT_EQ(multiplications(with_products_planned(by_halves(16, 7, 8), xc7), *xc7.chip()), 2);
}

TEST(Product, AnOddPieceIsABlockWhereOperationsShareBlocks) {
  const Library xc7 = library_called("xc7");
  Graph g("product");
  g.output("p", g.binary(Op::mul, g.input("a", 20, true), g.input("b", 20, true), true));
  EXPECT_EQ(multiplications(with_products_planned(g, xc7), *xc7.chip()), 1);
  EXPECT_EQ(multiplications(with_products_planned(g, xc7, 8), *xc7.chip()), 2);
}

TEST(Product, WithoutAChipTheGraphStays) {
  Graph g("g");
  g.output("p", g.binary(Op::mul, g.input("a", 24, true), g.input("b", 24, true), true));
  EXPECT_EQ(to_text(with_products_planned(g, Library::thesis())), to_text(g));
}

/// Bits high..low of the product, in two's complement if signed. Products have up to 64 bits.
std::uint64_t product(const MultiplierShape& s, std::uint64_t a, std::uint64_t b) {
  if (s.is_signed) {
    a = static_cast<std::uint64_t>(hls::sign_extended(a, s.width_a));
    b = static_cast<std::uint64_t>(hls::sign_extended(b, s.width_b));
  }
  return (a * b) >> s.low & hls::low_mask(s.high - s.low + 1);
}

std::string described(const MultiplierShape& s) {
  return fmt::format("{}x{}{} in {} stages, bits {}:{}", s.width_a, s.width_b, s.is_signed ? "s" : "u",
                     s.stages, s.high, s.low);
}

/// Both signs and all numbers of stages, each with all bits; without the repeated sign; the upper half; the
/// lower; one at each end; some within.
std::vector<MultiplierShape> shapes(int width_a, int width_b, int most_stages) {
  const int top = width_a + width_b - 1;
  std::vector<MultiplierShape> list;
  for (const bool is_signed : {true, false})
    for (int stages = 1; stages <= most_stages; ++stages)
      for (const auto& [high, low] : {std::pair{top, 0},
                                      {top - 1, 0},
                                      {top - 1, (top + 1) / 2},
                                      {(top + 1) / 2, 0},
                                      {top, top},
                                      {0, 0},
                                      {top - 2, 2}})
        list.push_back({width_a, width_b, is_signed, stages, high, low});
  return list;
}

struct Size {
  int width_a, width_b, most_stages;
};

TEST(Multiplier, EveryProductOfSmallWidths) {
  for (const auto& [width_a, width_b, most_stages] :
       {Size{5, 5, 4}, {6, 4, 4}, {4, 6, 4}, {5, 2, 2}, {3, 3, 3}, {4, 1, 1}}) {
    for (const MultiplierShape& shape : shapes(width_a, width_b, most_stages)) {
      const Graph graph = multiplier(shape, "mul");
      for (std::uint64_t a = 0; a <= hls::low_mask(width_a); ++a)
        for (std::uint64_t b = 0; b <= hls::low_mask(width_b); ++b)
          ASSERT_EQ(evaluate(graph, std::array{a, b}).at(0), product(shape, a, b))
              << described(shape) << ", a " << a << ", b " << b;
    }
  }
}

TEST(Multiplier, RandomProductsOfLargeWidths) {
  Seeded random(127);
  for (const auto& [width_a, width_b, most_stages] :
       {Size{24, 24, 4}, {32, 32, 4}, {32, 24, 8}, {20, 27, 5}}) {
    for (const MultiplierShape& shape : shapes(width_a, width_b, most_stages)) {
      const Graph graph = multiplier(shape, "mul");
      for (int v = 0; v < 2000; ++v) {
        const std::uint64_t a = random.value(width_a);
        const std::uint64_t b = random.value(width_b);
        ASSERT_EQ(evaluate(graph, std::array{a, b}).at(0), product(shape, a, b))
            << described(shape) << std::hex << ", a " << a << ", b " << b;
      }
    }
  }
}

TEST(Multiplier, PartitionAsText) {
  EXPECT_EQ(to_text(multiplier({6, 4, true, 2, 8, 3}, "mul")), R"(graph mul
%0 = input:6 signed  a
%1 = input:4 signed  b
%2 = slice:2 %1 [1:0]
%3 = extend:3 %2
%4 = mul:9 signed %0 %3 stage>=1  piece_0
%5 = slice:7 %4 [8:2]
%6 = slice:2 %1 [3:2]
%7 = mul:8 signed %0 %6 stage>=1  piece_1
%8 = slice:7 %7 [6:0]
%9 = add:7 %5 %8 stage>=2  sum_1
%10 = slice:6 %9 [6:1]
output p %10
)");
}

// Stage 1 has the multiplications, each later stage one addition. So there is one stage for each piece.
TEST(Multiplier, StagesAreAsStated) {
  for (const MultiplierShape& shape :
       {MultiplierShape{24, 24, true, 3, 46, 23}, MultiplierShape{20, 20, true, 2, 38, 15},
        MultiplierShape{32, 32, false, 4, 63, 0}, MultiplierShape{6, 4, true, 1, 9, 0}}) {
    SCOPED_TRACE(described(shape));
    const Graph graph = multiplier(shape, "mul");
    const Schedule schedule = schedule_as_stated(graph, shape.stages);
    std::vector<int> multiplications(static_cast<std::size_t>(shape.stages) + 1, 0);
    std::vector<int> additions = multiplications;
    for (NodeId id = 0; id < graph.size(); ++id) {
      const Node& n = graph[id];
      if (!is_root(n.op) || n.op == Op::input) continue;
      ASSERT_EQ(schedule.slots[id].stage, n.min_stage) << n.name;
      ASSERT_EQ(schedule.slots[id].finish, n.min_stage) << n.name;
      ++(n.op == Op::mul ? multiplications : additions)[static_cast<std::size_t>(n.min_stage)];
      if (n.op != Op::mul) continue;
      EXPECT_EQ(graph[n.args[0]].width, shape.width_a);
      EXPECT_LE(graph[n.args[1]].width, shape.width_b / shape.stages + (shape.is_signed ? 1 : 0));
    }
    std::vector<int> one_each(multiplications.size(), 1);
    one_each[0] = one_each[1] = 0;
    EXPECT_EQ(additions, one_each);
    EXPECT_EQ(multiplications[1], shape.stages);
    EXPECT_EQ(std::count(multiplications.begin(), multiplications.end(), 0), shape.stages);
    for (const Register& r : place_registers(graph, schedule, Ports::direct).registers) {
      EXPECT_GE(r.boundary, 1);
      EXPECT_LT(r.boundary, shape.stages) << "the product itself is latched by its user";
      EXPECT_NE(graph[r.value].op, Op::input) << "operands are read in stage 1 only";
    }
  }
}

}  // namespace
}  // namespace hitpipe::rtl::product_test
