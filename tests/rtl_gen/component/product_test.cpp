// Products on a chip: every plan gives the product, and takes no more blocks than it may.
#include "rtl_gen/component/product.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "rtl_gen/component/library.hpp"
#include "rtl_gen/graph/canonical.hpp"
#include "tests/rtl_gen/seeded.hpp"

namespace hitpipe::rtl::product_test {
namespace {

constexpr std::uint64_t ones(int width) {
  return ~std::uint64_t{0} >> (64 - width);
}

std::uint64_t extended(std::uint64_t value, int width, bool is_signed) {
  return is_signed && (value >> (width - 1)) != 0 ? value | ~ones(width) : value;
}

std::uint64_t true_product(const ProductShape& s, std::uint64_t a, std::uint64_t b) {
  return (extended(a, s.width_a, s.a_signed) * extended(b, s.width_b, s.b_signed)) & ones(s.width());
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

/// Chips whose blocks cut small products in every way; where a block is worth nothing, much, or all.
std::vector<Chip> small_chips() {
  std::vector<Chip> chips{chip_with(0, 0, false, 0)};
  for (const int luts : {0, 12, 1000}) {
    for (const bool reads_unsigned : {true, false}) {
      chips.push_back(chip_with(4, 3, reads_unsigned, luts));
      chips.push_back(chip_with(3, 3, reads_unsigned, luts));
    }
  }
  return chips;
}

TEST(Product, EveryValueOfSmallWidths) {
  int compared = 0;
  for (const Chip& chip : small_chips()) {
    for (int width_a = 1; width_a <= 5; ++width_a) {
      for (int width_b = 1; width_b <= 5; ++width_b) {
        for (const int signs : {0, 1, 2, 3}) {
          const ProductShape s{width_a, width_b, (signs & 1) != 0, (signs & 2) != 0};
          const ProductPlan plan = plan_product(s, chip);
          const Graph graph = made(s, plan);
          EXPECT_LE(multiplications(graph, chip), plan.blocks);
          for (std::uint64_t a = 0; a <= ones(width_a); ++a) {
            for (std::uint64_t b = 0; b <= ones(width_b); ++b, ++compared) {
              ASSERT_EQ(evaluate(graph, std::vector<std::uint64_t>{a, b}).at(0), true_product(s, a, b))
                  << sized(s) << ", a " << a << ", b " << b;
            }
          }
        }
      }
    }
  }
  EXPECT_EQ(compared, 13 * 4 * 62 * 62);
}

TEST(Product, RandomValuesOnEveryChip) {
  Seeded random(1122);
  int chips = 0;
  for (const std::string& name : built_in_names()) {
    const Library library = library_called(name);
    if (library.chip() == nullptr) continue;
    ++chips;
    for (int i = 0; i < 60; ++i) {
      const ProductShape s{random.between(1, 32), random.between(1, 32), random.flip(), random.flip()};
      const ProductPlan plan = plan_product(s, *library.chip());
      const Graph graph = made(s, plan);
      EXPECT_LE(multiplications(graph, *library.chip()), plan.blocks);
      for (int v = 0; v < 100; ++v) {
        const std::uint64_t a = random.value(s.width_a);
        const std::uint64_t b = random.value(s.width_b);
        ASSERT_EQ(evaluate(graph, std::vector<std::uint64_t>{a, b}).at(0), true_product(s, a, b))
            << name << ' ' << sized(s) << std::hex << ", a " << a << ", b " << b;
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

/// A block multiplies signed operands one bit wider than unsigned ones, if it knows signed ones alone.
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

TEST(Product, WithoutAChipTheGraphStays) {
  Graph g("g");
  g.output("p", g.binary(Op::mul, g.input("a", 24, true), g.input("b", 24, true), true));
  EXPECT_EQ(to_text(with_products_planned(g, Library::thesis())), to_text(g));
}

}  // namespace
}  // namespace hitpipe::rtl::product_test
