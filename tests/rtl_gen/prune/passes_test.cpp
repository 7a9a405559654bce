// Each pass alone: what it makes of small graphs, and that on random graphs no output changes for operands as
// demanded.
#include <functional>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rtl_gen/graph/canonical.hpp"
#include "rtl_gen/prune/prune.hpp"
#include "tests/rtl_gen/graph/recipe.hpp"
#include "tests/rtl_gen/prune/random_demands.hpp"

namespace hitpipe::rtl::passes_test {
namespace {

struct PassCase {
  const char* name;
  std::function<Graph(const Graph&, const Demands&)> run;
};
void PrintTo(const PassCase& pass, std::ostream* out) {
  *out << pass.name;
}

std::vector<PassCase> every_pass() {
  const auto alone = [](Graph (*run)(const Graph&)) {
    return [run](const Graph& graph, const Demands&) { return run(graph); };
  };
  return {{"fold_constants", fold_constants},
          {"decide_comparisons", decide_comparisons},
          {"simplify_muxes", simplify_muxes},
          {"simplify_gates", alone(simplify_gates)},
          {"simplify_arithmetic", alone(simplify_arithmetic)},
          {"narrow", narrow},
          {"share", alone(share)},
          {"narrow_ports", [](const Graph& graph,
                              const Demands& demands) { return narrow_ports(canonical(graph), demands); }},
          {"prune", [](const Graph& graph, const Demands& demands) {
             return prune(graph, demands, {.shares = false}).graph;
           }}};
}

class EveryPass : public testing::TestWithParam<PassCase> {};

TEST_P(EveryPass, KeepsTheOutputsOfRandomGraphs) {
  Seeded random(733);
  std::size_t vectors = 0;
  std::size_t changed = 0;
  for (int round = 0; round < 250; ++round) {
    const Graph graph = Recipe(random, 4, 40, 3, round % 4 == 0 ? most_value_bits : 64).graph();
    const std::vector<Port> ports = input_ports(graph);
    const Demands demands = random_demands(random, ports);
    const Graph made = GetParam().run(graph, demands);
    changed += to_text(canonical(made)) != to_text(canonical(graph)) ? 1 : 0;
    const Draw draw(ports, demands);
    for (int i = 0; i < 40; ++i, ++vectors) {
      const std::vector<std::int64_t> operands = draw(random);
      const std::vector<std::uint64_t> all(operands.begin(), operands.end());
      ASSERT_EQ(evaluate(made, operands_left(made, ports, operands)), evaluate(graph, all))
          << to_text(graph) << to_text(made) << testing::PrintToString(operands);
    }
  }
  std::cout << vectors << " vectors, " << changed << " graphs changed\n";
  EXPECT_EQ(vectors, 10'000U);
  EXPECT_GT(changed, 25U);
}

INSTANTIATE_TEST_SUITE_P(Passes, EveryPass, testing::ValuesIn(every_pass()),
                         [](const auto& pass) { return std::string(pass.param.name); });

/// Two signed 8-bit ports, two bits, and what a test makes of them.
struct Small : testing::Test {
  Graph graph{"small"};
  NodeId a = graph.input("a", 8, true);
  NodeId b = graph.input("b", 8, true);
  NodeId p = graph.input("p", 1, false);
  NodeId q = graph.input("q", 1, false);

  /// "add:8 xor:1": the nodes that are left, without inputs.
  [[nodiscard]] static std::string ops(const Graph& made) {
    const Graph clean = canonical(made);
    std::vector<std::string> found;
    for (NodeId id = 0; id < clean.size(); ++id)
      if (clean[id].op != Op::input)
        found.push_back(fmt::format("{}:{}", op_name(clean[id].op), clean[id].width));
    return fmt::format("{}", fmt::join(found, " "));
  }
  using Cases = std::vector<std::pair<NodeId, std::string>>;
  /// Each node alone is the output; the pass leaves these nodes of it.
  template <class Pass>
  void expect_left(const Pass& pass, const Cases& cases) const {
    for (const auto& [node, left] : cases) {
      Graph each = graph;
      each.output("o", node);
      EXPECT_EQ(ops(pass(each)), left) << to_text(each);
    }
  }
  /// The same for narrow(), which leaves this node among others.
  void expect_narrow(const Demands& demands, const Cases& cases) const {
    for (const auto& [node, left] : cases) {
      Graph each = graph;
      each.output("o", node);
      EXPECT_THAT(ops(narrow(each, demands)), testing::HasSubstr(left)) << to_text(narrow(each, demands));
    }
  }
};

TEST_F(Small, FoldConstantsTakesWhatHasOneValueButComparisons) {
  const Demands demands{{{"a", {{2, 2}}}, {"b", {{3, 3}}}}};
  const NodeId sum = graph.binary(Op::add, a, b);
  const auto fold = [&](const Graph& each) { return fold_constants(each, demands); };
  expect_left(fold, {{sum, "const:8"}, {graph.binary(Op::less, a, b, true), "const:8 const:8 cmp:1"}});
  graph.output("o", sum);
  EXPECT_EQ(ops(fold_constants(graph, {{{"a", {{2, 2}}}}})), "const:8 add:8");
}

TEST_F(Small, DecideComparisonsByRangeAndOrder) {
  graph.output("o", graph.binary(Op::less, a, b, true));
  const auto left = [&](const Demands& demands) { return ops(decide_comparisons(graph, demands)); };
  EXPECT_EQ(left({{{"a", {{-9, 2}}}, {"b", {{3, 9}}}}}), "const:1");
  EXPECT_EQ(left({{{"a", {{-9, 3}}}, {"b", {{3, 9}}}}}), "cmp:1");
  EXPECT_EQ(left({{{"a", {{3, 9}}}, {"b", {{-9, 3}}}}}), "const:1");
  EXPECT_EQ(left({{}, {{"b", "a"}}}), "const:1");
  EXPECT_EQ(left({{}, {{"a", "b"}}}), "cmp:1");
}

TEST_F(Small, DecideComparisonsReadsTheSign) {
  graph.output("o", graph.binary(Op::less, a, graph.constant(8, 0), true));
  EXPECT_EQ(ops(decide_comparisons(graph, {})), "slice:1");
}

TEST_F(Small, SimplifyMuxesTakesTheKnownArm) {
  graph.output("o", graph.mux(p, a, b));
  const Graph made = simplify_muxes(graph, {{{"p", {{0, 0}}}}});
  EXPECT_EQ(made.outputs().front().node, made.inputs()[1]);
  EXPECT_EQ(ops(simplify_muxes(graph, {})), "mux:8");
}

TEST_F(Small, SimplifyMuxesMakesGates) {
  expect_left([](const Graph& each) { return simplify_muxes(each, {}); },
              {{graph.mux(p, graph.constant(1, 1), q), "or:1"},
               {graph.mux(p, graph.constant(1, 0), q), "not:1 and:1"}});
}

TEST_F(Small, SimplifyMuxesLooksThroughTheSameSelect) {
  graph.output("o", graph.mux(p, graph.mux(p, a, b), graph.mux(p, a, b)));
  graph.output("o2", graph.mux(p, a, graph.mux(p, b, a)));
  const Graph made = canonical(simplify_muxes(graph, {}));
  EXPECT_EQ(ops(made), "mux:8");
  EXPECT_EQ(made.outputs()[1].node, made.inputs()[0]);
}

TEST_F(Small, SimplifyGatesKnowsConstantsAndEqualAndOppositeOperands) {
  const NodeId one = graph.constant(1, 1);
  const NodeId zero = graph.constant(1, 0);
  expect_left(simplify_gates, {{graph.binary(Op::bit_and, p, one), ""},
                               {graph.binary(Op::bit_and, zero, p), "const:1"},
                               {graph.binary(Op::bit_or, one, p), "const:1"},
                               {graph.binary(Op::bit_or, p, zero), ""},
                               {graph.binary(Op::bit_xor, p, one), "not:1"},
                               {graph.binary(Op::bit_xor, p, zero), ""},
                               {graph.binary(Op::bit_and, p, p), ""},
                               {graph.binary(Op::bit_or, p, p), ""},
                               {graph.binary(Op::bit_xor, p, p), "const:1"},
                               {graph.binary(Op::bit_and, p, graph.invert(p)), "const:1"},
                               {graph.binary(Op::bit_or, graph.invert(p), p), "const:1"},
                               {graph.binary(Op::bit_and, p, graph.invert(q)), "not:1 and:1"}});
}

TEST_F(Small, SimplifyArithmeticMakesWires) {
  const NodeId zero = graph.constant(8, 0);
  expect_left(simplify_arithmetic,
              {{graph.binary(Op::sub, a, zero), ""},
               {graph.binary(Op::add, zero, a), ""},
               {graph.binary(Op::sub, a, a), "const:8"},
               {graph.binary(Op::sub, zero, a), "const:8 sub:8"},
               {graph.binary(Op::mul, a, zero, true), "const:16"},
               {graph.binary(Op::mul, a, graph.constant(8, 1), true), "extend:16"},
               {graph.binary(Op::mul, graph.constant(8, 4), a, true), "extend:14 const:2 concat:16"},
               {graph.binary(Op::mul, a, graph.constant(8, 0x80), true), "const:8 mul:16"}});
}

TEST_F(Small, NarrowMakesValuesInTheBitsTheyNeed) {
  expect_narrow({{{"a", {{-5, 5}}}, {"b", {{-3, 3}}}}}, {{graph.binary(Op::sub, a, b), "sub:5"},
                                                         {graph.binary(Op::mul, a, b, true), "mul:7"},
                                                         {graph.binary(Op::less, a, b, true), "cmp:1"},
                                                         {graph.mux(p, a, b), "mux:4"}});
}

/// What is left of a value when the low two bits of a and the low three of b are 0.
TEST_F(Small, NarrowLeavesOutLowZeros) {
  expect_narrow({{{"a", {{-128, 127}}, 2}, {"b", {{-128, 127}}, 3}}},
                {{graph.binary(Op::add, a, b), "add:5"},
                 {graph.binary(Op::sub, a, b), "sub:5"},
                 {graph.binary(Op::sub, b, a), "sub:6"},
                 {graph.binary(Op::mul, a, b, true), "mul:11"},
                 {graph.binary(Op::mul, a, b, false), "mul:11"},
                 {graph.binary(Op::bit_and, a, b), "and:5"},
                 {graph.binary(Op::bit_or, a, b), "or:6"},
                 {graph.mux(p, a, b), "mux:6"}});
}

TEST_F(Small, NarrowLetsLowBitsPassWhereTheOtherOperandHasNone) {
  expect_narrow({{{"b", {{-128, 127}}, 3}}}, {{graph.binary(Op::add, a, b), "add:5"},
                                              {graph.binary(Op::add, b, a), "add:5"},
                                              {graph.binary(Op::sub, a, b), "sub:5"},
                                              {graph.binary(Op::sub, b, a), "sub:8"}});
}

TEST_F(Small, NarrowComparesAboveEqualLowBits) {
  for (const Op op : {Op::less, Op::equal}) {
    for (const bool is_signed : {false, true}) {
      const auto compared_bits = [&](std::uint64_t low_a, std::uint64_t low_b) {
        Graph each = graph;
        const NodeId left = each.concat(each.slice(a, 7, 2), each.constant(2, low_a));
        const NodeId right = each.concat(each.slice(b, 7, 2), each.constant(2, low_b));
        each.output("o", each.binary(op, left, right, is_signed && op == Op::less));
        const Graph made = narrow(each, {});
        return made[made[made.outputs().front().node].args[0]].width;
      };
      EXPECT_EQ(compared_bits(1, 1), 6);
      EXPECT_EQ(compared_bits(1, 2), 8);
    }
  }
}

TEST_F(Small, NarrowKnowsLowBitsThatACarryLeaves) {
  const NodeId three = graph.concat(graph.slice(a, 7, 2), graph.constant(2, 3));
  const NodeId one = graph.concat(graph.slice(b, 7, 2), graph.constant(2, 1));
  graph.output("o", graph.binary(Op::add, three, one));
  const Graph made = canonical(narrow(graph, {}));
  const Node& sum = made[made.outputs().front().node];
  ASSERT_EQ(sum.op, Op::concat) << to_text(made);
  EXPECT_EQ(made[sum.args[1]].op, Op::constant);
  EXPECT_THAT(ops(made), testing::HasSubstr("add:8"));
}

TEST_F(Small, NarrowComparesWithoutASignWhereItIsKnown) {
  graph.output("o", graph.binary(Op::less, a, b, true));
  const Graph made = narrow(graph, {{{"a", {{64, 71}}}, {"b", {{66, 70}}}}});
  const Node& compare = made[made.outputs().front().node];
  EXPECT_FALSE(compare.is_signed);
  EXPECT_EQ(made[compare.args[0]].width, 3);
  EXPECT_TRUE(narrow(graph, {})[graph.outputs().front().node].is_signed);
}

TEST_F(Small, NarrowKeepsTheNameAtTheComponent) {
  graph.output("o", graph.binary(Op::sub, a, b));
  graph.annotate(graph.outputs().front().node, "gap", {"hls/here.hpp", 7});
  EXPECT_THAT(to_text(canonical(narrow(graph, {{{"a", {{0, 1}}}, {"b", {{0, 1}}}}}))),
              testing::ContainsRegex("sub:[0-9]+ [^\n]*gap @"));
}

TEST_F(Small, ShareJoinsTurnedOperands) {
  expect_left(
      share,
      {{graph.binary(Op::bit_xor, graph.binary(Op::add, a, b), graph.binary(Op::add, b, a)), "add:8 xor:8"},
       {graph.concat(graph.binary(Op::sub, a, b), graph.binary(Op::sub, b, a)), "sub:8 sub:8 concat:16"}});
}

TEST_F(Small, NarrowPortsDropsAndCuts) {
  graph.output("o", graph.extend(graph.slice(a, 3, 0), 8, true));
  graph.output("sign", graph.slice(b, 7, 7));
  const std::vector<Port> ports =
      input_ports(canonical(narrow_ports(canonical(graph), {{{"a", {{-8, 7}}}}})));
  ASSERT_EQ(ports.size(), 2U);
  EXPECT_EQ(ports[0].name, "a");
  EXPECT_EQ(ports[0].width, 4);
  EXPECT_TRUE(ports[0].is_signed) << "its numbers fit";
  EXPECT_EQ(ports[1].width, 8) << "bits below the highest that is read stay";
}

TEST_F(Small, NarrowPortsHaveNoSignWhereNumbersDoNotFit) {
  graph.output("o", graph.slice(a, 3, 0));
  const std::vector<Port> ports = input_ports(narrow_ports(canonical(graph), {}));
  ASSERT_EQ(ports.size(), 1U);
  EXPECT_FALSE(ports[0].is_signed);
}

}  // namespace
}  // namespace hitpipe::rtl::passes_test
