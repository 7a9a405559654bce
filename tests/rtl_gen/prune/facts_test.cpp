// What the analysis says of every value holds of it: on random graphs, and exactly where it can be exact.
#include "rtl_gen/prune/facts.hpp"

#include <array>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "rtl_gen/graph/graph_lanes.hpp"
#include "tests/rtl_gen/graph/recipe.hpp"
#include "tests/rtl_gen/prune/random_demands.hpp"

namespace hitpipe::rtl::facts_test {
namespace {

bool holds(const Facts& facts, Word value) {
  const Number number = number_of<Word>(value, facts.width());
  return (value & facts.zeros()) == 0 && (~value & facts.ones()) == 0 && number >= facts.number().low &&
         number <= facts.number().high && value >= facts.patterns().low && value <= facts.patterns().high;
}

/// Every interval with every number of low zeros that leaves it a number.
std::vector<PortDemand> three_bit_demands(const std::string& port, bool is_signed) {
  std::vector<PortDemand> all;
  const Interval numbers = all_numbers({port, 3, is_signed});
  for (std::int64_t low = numbers.low; low <= numbers.high; ++low)
    for (std::int64_t high = low; high <= numbers.high; ++high)
      for (int zeros = 0; zeros < 3; ++zeros)
        if (multiples_in({low, high}, zeros)) all.push_back({port, {{low, high}}, zeros});
  return all;
}

std::vector<std::uint64_t> patterns_of(const PortDemand& demand) {
  std::vector<std::uint64_t> patterns;
  for (std::int64_t number = demand.within[0].low; number <= demand.within[0].high; ++number)
    if (meets(demand, number)) patterns.push_back(static_cast<std::uint64_t>(number) & 7);
  return patterns;
}

TEST(Facts, NumbersAndBitsSharpenEachOther) {
  const Facts small = Facts::number(8, 0, 9);
  EXPECT_EQ(small.zeros(), 0xf0U);
  EXPECT_EQ(small.signed_width(), 5);
  EXPECT_EQ(small.unknown_width(), 4);
  const Facts negative = Facts::number(8, -9, -1);
  EXPECT_EQ(negative.ones(), 0xf0U);
  const Facts by_bits = Facts::bits(8, 0x80, 0x10);
  EXPECT_EQ(by_bits.number(), (Numbers{16, 127}));
  EXPECT_TRUE(Facts::constant(64, ~std::uint64_t{0}).is_constant());
  EXPECT_EQ(Facts::nothing(64).signed_width(), 64);
  EXPECT_EQ(Facts::nothing(64).unknown_width(), 64);
}

TEST(Facts, LowBitsMoveTheEndsToNumbersThatHaveThem) {
  const Facts even = Facts::both(Facts::number(8, -9, 9), Facts::bits(8, 0x03, 0));
  EXPECT_EQ(even.number(), (Numbers{-8, 8}));
  EXPECT_EQ(even.low_zeros(), 2);
  const Facts odd = Facts::both(Facts::number(8, -9, 9), Facts::bits(8, 0x02, 0x01));
  EXPECT_EQ(odd.number(), (Numbers{-7, 9}));
  EXPECT_EQ(odd.low_zeros(), 0);
  EXPECT_EQ(odd.known_low(), 2);
  const Facts one = Facts::both(Facts::number(8, 9, 15), Facts::bits(8, 0x03, 0));
  EXPECT_TRUE(one.is_constant());
  EXPECT_EQ(one.known_low(), 8);
  EXPECT_EQ(Facts::nothing(64).known_low(), 0);
}

TEST(Facts, WhatDoesNotFitSaysNothing) {
  EXPECT_EQ(Facts::number(8, 0, 128).number(), (Numbers{-128, 127}));
  EXPECT_EQ(Facts::patterns(8, {127, 128}).number(), (Numbers{-128, 127}));
  EXPECT_EQ(Facts::patterns(8, {200, 255}).number(), (Numbers{-56, -1}));
}

/// Every operation on every pair of demands on 3-bit numbers, intervals with and without low zeros, signed
/// and unsigned: all results are in the facts.
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
    std::array<std::array<std::vector<std::uint64_t>, 8>, 8> values;
    for (std::uint64_t x = 0; x < 8; ++x)
      for (std::uint64_t y = 0; y < 8; ++y) values[x][y] = evaluate(graph, std::array{x, y});
    const std::vector<PortDemand> of_a = three_bit_demands("a", is_signed);
    const std::vector<PortDemand> of_b = three_bit_demands("b", is_signed);
    for (const PortDemand& demand_a : of_a)
      for (const PortDemand& demand_b : of_b) {
        const std::vector<Facts> facts = analyse(graph, {{demand_a, demand_b}, {}});
        for (const std::uint64_t x : patterns_of(demand_a))
          for (const std::uint64_t y : patterns_of(demand_b))
            for (const Output& out : graph.outputs()) {
              const auto o = static_cast<std::size_t>(&out - graph.outputs().data());
              ASSERT_TRUE(holds(facts[out.node], values[x][y][o]))
                  << to_text(graph) << "%" << out.node << " a=" << x << " b=" << y << ' '
                  << demand_text(demand_a) << ' ' << demand_text(demand_b);
              ++cases;
            }
      }
  }
  EXPECT_GT(cases, 800'000U);
}

TEST(Analysis, HoldsOnRandomGraphs) {
  Seeded random(401);
  for (int round = 0; round < 400; ++round) {
    const Graph graph = Recipe(random, 4, 40, 3, round % 4 == 0 ? most_value_bits : 64).graph();
    GraphLanes lanes(graph);
    const Demands demands = random_demands(random, input_ports(graph));
    const std::vector<Facts> facts = analyse(graph, demands);
    const Draw draw(input_ports(graph), demands);
    for (int i = 0; i < 50; ++i) {
      const std::vector<std::int64_t> operands = draw(random);
      lanes.load(std::array{operands});
      for (NodeId id = 0; id < graph.size(); ++id) {
        const Word value = lanes.right(id).front();
        ASSERT_TRUE(holds(facts[id], value)) << to_text(graph) << fmt::format("%{} = {:#x}", id, value);
      }
    }
  }
}

TEST(Analysis, KnowsTheLesserAndTheGreaterOfTwo) {
  Graph graph("extremes");
  const NodeId a = graph.input("a", 8, true);
  const NodeId b = graph.input("b", 8, true);
  const NodeId less = graph.binary(Op::less, a, b, true);
  const NodeId greater = graph.mux(less, b, a);
  const NodeId lesser = graph.mux(less, a, b);
  const std::vector<Facts> facts = analyse(graph, {{{"a", {{-5, 50}}}, {"b", {{3, 10}}}}, {}});
  EXPECT_EQ(facts[greater].number(), (Numbers{3, 50}));
  EXPECT_EQ(facts[lesser].number(), (Numbers{-5, 10}));
}

TEST(Analysis, KnowsPortsInOrder) {
  Graph graph("ordered");
  const NodeId a = graph.extend(graph.input("a", 8, true), 10, true);
  const NodeId b = graph.extend(graph.input("b", 8, true), 10, true);
  const NodeId gap = graph.binary(Op::sub, b, a);
  const NodeId turned = graph.binary(Op::less, b, a, true);
  const std::vector<Facts> free = analyse(graph, {});
  EXPECT_EQ(free[gap].number(), (Numbers{-255, 255}));
  EXPECT_FALSE(free[turned].is_constant());
  const std::vector<Facts> facts = analyse(graph, {{}, {{"a", "b"}}});
  EXPECT_EQ(facts[gap].number(), (Numbers{0, 255}));
  ASSERT_TRUE(facts[turned].is_constant());
  EXPECT_EQ(facts[turned].pattern(), 0U);
  const std::vector<Facts> tight = analyse(graph, {{{"a", {{5, 100}}}, {"b", {{-100, 20}}}}, {{"a", "b"}}});
  EXPECT_EQ(tight[graph.inputs()[0]].number(), (Numbers{5, 20}));
  EXPECT_EQ(tight[graph.inputs()[1]].number(), (Numbers{5, 20}));
}

TEST(Analysis, CarriesLowZerosAsFarAsTheyGo) {
  for (const bool is_signed : {false, true}) {
    Graph graph("zeros");
    const NodeId a = graph.input("a", 8, is_signed);
    const NodeId b = graph.input("b", 8, is_signed);
    const NodeId p = graph.input("p", 1, false);
    const std::vector<std::pair<NodeId, int>> cases{{graph.binary(Op::add, a, b), 2},
                                                    {graph.binary(Op::sub, b, a), 2},
                                                    {graph.binary(Op::mul, a, b, is_signed), 5},
                                                    {graph.mux(p, a, b), 2},
                                                    {graph.extend(b, 20, is_signed), 3},
                                                    {graph.slice(a, 6, 1), 1},
                                                    {graph.concat(p, b), 3},
                                                    {graph.binary(Op::bit_and, a, b), 3},
                                                    {graph.binary(Op::bit_xor, a, b), 2}};
    const Interval whole = all_numbers({"a", 8, is_signed});
    const std::vector<Facts> facts = analyse(graph, {{{"a", {whole}, 2}, {"b", {whole}, 3}}, {}});
    for (const auto& [node, zeros] : cases)
      EXPECT_EQ(facts[node].low_zeros(), zeros) << to_text(graph) << '%' << node;
  }
}

TEST(Analysis, LooksIntoAComponent) {
  Graph body("sign_of");
  body.output("y", body.slice(body.input("a", 8, false), 7, 7));
  const auto unit = std::make_shared<const Submodule>(Submodule{"fp_compare", 8, body});
  Graph graph("caller");
  const std::array operands{graph.input("a", 8, false)};
  const NodeId called = graph.call(unit, operands);
  EXPECT_FALSE(analyse(graph, {})[called].is_constant());
  const std::vector<Facts> facts = analyse(graph, {{{"a", {{0, 127}}}}, {}});
  ASSERT_TRUE(facts[called].is_constant());
  EXPECT_EQ(facts[called].pattern(), 0U);
}

}  // namespace
}  // namespace hitpipe::rtl::facts_test
