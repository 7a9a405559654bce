// What the analysis says of every value holds of it: on random graphs, and exactly where it can be exact.
#include "rtl_gen/prune/facts.hpp"

#include <array>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "rtl_gen/prune/analysis.hpp"
#include "tests/rtl_gen/graph/recipe.hpp"
#include "tests/rtl_gen/prune/random_demands.hpp"

namespace hitpipe::rtl {
namespace {

bool holds(const Facts& facts, std::uint64_t value) {
  const std::int64_t number = number_of(value, facts.width());
  return (value & facts.zeros()) == 0 && (~value & facts.ones()) == 0 && number >= facts.number().low &&
         number <= facts.number().high && value >= facts.patterns().low && value <= facts.patterns().high;
}

TEST(Facts, NumbersAndBitsSharpenEachOther) {
  const Facts small = Facts::number(8, 0, 9);
  EXPECT_EQ(small.zeros(), 0xf0U);
  EXPECT_EQ(small.signed_width(), 5);
  EXPECT_EQ(small.unknown_width(), 4);
  const Facts negative = Facts::number(8, -9, -1);
  EXPECT_EQ(negative.ones(), 0xf0U);
  const Facts by_bits = Facts::bits(8, 0x80, 0x10);
  EXPECT_EQ(by_bits.number(), (Interval{16, 127}));
  EXPECT_TRUE(Facts::constant(64, ~std::uint64_t{0}).is_constant());
  EXPECT_EQ(Facts::nothing(64).signed_width(), 64);
  EXPECT_EQ(Facts::nothing(64).unknown_width(), 64);
}

TEST(Facts, WhatDoesNotFitSaysNothing) {
  EXPECT_EQ(Facts::number(8, 0, 128).number(), (Interval{-128, 127}));
  EXPECT_EQ(Facts::patterns(8, {127, 128}).number(), (Interval{-128, 127}));
  EXPECT_EQ(Facts::patterns(8, {200, 255}).number(), (Interval{-56, -1}));
}

/// Every operation on every pair of intervals of 3-bit numbers, signed and unsigned: all results are in the
/// facts, and differences and products that do not wrap reach the ends.
TEST(Analysis, HoldsForEveryPairOfThreeBitIntervals) {
  std::size_t cases = 0;
  for (const bool is_signed : {false, true}) {
    Graph graph("small");
    const NodeId a = graph.input("a", 3, is_signed);
    const NodeId b = graph.input("b", 3, is_signed);
    const NodeId less = graph.binary(Op::less, a, b, is_signed);
    for (const NodeId id :
         {graph.binary(Op::add, a, b), graph.binary(Op::sub, a, b), graph.binary(Op::mul, a, b, is_signed),
          less, graph.binary(Op::equal, a, b), graph.mux(less, b, a), graph.mux(less, a, b),
          graph.concat(a, b), graph.extend(a, 5, is_signed), graph.slice(a, 2, 1), graph.slice(a, 1, 0),
          graph.slice(b, 1, 1), graph.invert(a), graph.binary(Op::bit_and, a, b),
          graph.binary(Op::bit_or, a, b), graph.binary(Op::bit_xor, a, b)})
      graph.output(fmt::format("o{}", id), id);
    const std::int64_t low = is_signed ? -4 : 0;
    for (std::int64_t a0 = low; a0 < low + 8; ++a0)
      for (std::int64_t a1 = a0; a1 < low + 8; ++a1)
        for (std::int64_t b0 = low; b0 < low + 8; ++b0)
          for (std::int64_t b1 = b0; b1 < low + 8; ++b1) {
            const std::vector<Facts> facts = analyse(graph, {{{"a", {{a0, a1}}}, {"b", {{b0, b1}}}}, {}});
            for (std::int64_t x = a0; x <= a1; ++x)
              for (std::int64_t y = b0; y <= b1; ++y) {
                const std::array operands{static_cast<std::uint64_t>(x), static_cast<std::uint64_t>(y)};
                const std::vector<std::uint64_t> values = evaluate(graph, operands);
                for (std::size_t o = 0; o < values.size(); ++o) {
                  const NodeId id = graph.outputs()[o].node;
                  ASSERT_TRUE(holds(facts[id], values[o]))
                      << to_text(graph) << "%" << id << " a=" << x << " in " << a0 << ".." << a1 << " b=" << y
                      << " in " << b0 << ".." << b1;
                  ++cases;
                }
              }
          }
  }
  std::cout << cases << " values\n";
  EXPECT_GT(cases, 400'000U);
}

TEST(Analysis, HoldsOnRandomGraphs) {
  Seeded random(401);
  std::size_t values = 0;
  for (int round = 0; round < 400; ++round) {
    const Recipe recipe(random, 4, 40, 3);
    Graph graph = recipe.graph();
    for (NodeId id = 0; id < graph.size(); ++id) graph.output(fmt::format("all{}", id), id);
    const Demands demands = random_demands(random, input_ports(graph));
    const std::vector<Facts> facts = analyse(graph, demands);
    const Draw draw(input_ports(graph), demands);
    for (int i = 0; i < 50; ++i) {
      const std::vector<std::int64_t> operands = draw(random);
      const std::vector<std::uint64_t> patterns(operands.begin(), operands.end());
      const std::vector<std::uint64_t> results = evaluate(graph, patterns);
      for (NodeId id = 0; id < graph.size(); ++id) {
        const std::uint64_t value = results[results.size() - graph.size() + id];
        ASSERT_TRUE(holds(facts[id], value)) << to_text(graph) << fmt::format("%{} = {:#x}", id, value);
        ++values;
      }
    }
  }
  std::cout << values << " values\n";
  EXPECT_GT(values, 500'000U);
}

TEST(Analysis, KnowsTheLesserAndTheGreaterOfTwo) {
  Graph graph("extremes");
  const NodeId a = graph.input("a", 8, true);
  const NodeId b = graph.input("b", 8, true);
  const NodeId less = graph.binary(Op::less, a, b, true);
  const NodeId greater = graph.mux(less, b, a);
  const NodeId lesser = graph.mux(less, a, b);
  const std::vector<Facts> facts = analyse(graph, {{{"a", {{-5, 50}}}, {"b", {{3, 10}}}}, {}});
  EXPECT_EQ(facts[greater].number(), (Interval{3, 50}));
  EXPECT_EQ(facts[lesser].number(), (Interval{-5, 10}));
}

TEST(Analysis, KnowsPortsInOrder) {
  Graph graph("ordered");
  const NodeId a = graph.extend(graph.input("a", 8, true), 10, true);
  const NodeId b = graph.extend(graph.input("b", 8, true), 10, true);
  const NodeId gap = graph.binary(Op::sub, b, a);
  const NodeId turned = graph.binary(Op::less, b, a, true);
  const std::vector<Facts> free = analyse(graph, {});
  EXPECT_EQ(free[gap].number(), (Interval{-255, 255}));
  EXPECT_FALSE(free[turned].is_constant());
  const std::vector<Facts> facts = analyse(graph, {{}, {{"a", "b"}}});
  EXPECT_EQ(facts[gap].number(), (Interval{0, 255}));
  ASSERT_TRUE(facts[turned].is_constant());
  EXPECT_EQ(facts[turned].pattern(), 0U);
  const std::vector<Facts> tight = analyse(graph, {{{"a", {{5, 100}}}, {"b", {{-100, 20}}}}, {{"a", "b"}}});
  EXPECT_EQ(tight[graph.inputs()[0]].number(), (Interval{5, 20}));
  EXPECT_EQ(tight[graph.inputs()[1]].number(), (Interval{5, 20}));
}

TEST(Analysis, LooksIntoAComponent) {
  Graph body("sign_of");
  body.output("y", body.slice(body.input("a", 8, false), 7, 7));
  const auto unit = std::make_shared<const Unit>(Unit{"fp_compare", 8, body});
  Graph graph("caller");
  const std::array operands{graph.input("a", 8, false)};
  const NodeId called = graph.call(unit, operands);
  EXPECT_FALSE(analyse(graph, {})[called].is_constant());
  const std::vector<Facts> facts = analyse(graph, {{{"a", {{0, 127}}}}, {}});
  ASSERT_TRUE(facts[called].is_constant());
  EXPECT_EQ(facts[called].pattern(), 0U);
}

}  // namespace
}  // namespace hitpipe::rtl
