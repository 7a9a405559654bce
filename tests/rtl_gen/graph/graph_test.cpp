// Recording, the peephole rules of wires, the text form, the messages; evaluate() against the plain meaning
// of the steps; the sources of bits; calls, which are components with a graph of their own inside.
#include "rtl_gen/graph/graph.hpp"

#include <array>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "rtl_gen/graph/canonical.hpp"
#include "rtl_gen/graph/sources.hpp"
#include "tests/message_of.hpp"
#include "tests/rtl_gen/graph/recipe.hpp"

namespace hitpipe::rtl::graph_test {
namespace {

struct Words : testing::Test {
  Graph g{"words"};
  NodeId a = g.input("a", 8, true);
  NodeId b = g.input("b", 8, false);
  NodeId bit = g.input("bit", 1, false);
};

TEST_F(Words, PrintsOneLineANode) {
  const NodeId wide = g.extend(a, 9, true);
  const NodeId nine = g.constant(9, 0x1ff);
  const NodeId difference = g.binary(Op::sub, wide, nine);
  g.annotate(difference, "d", {"hls/pipelines/toy.hpp", 12});
  const NodeId product = g.binary(Op::mul, a, g.slice(difference, 8, 1), true);
  g.begin_stage(2);
  const NodeId chosen = g.mux(bit, g.concat(bit, b), difference);
  g.output("less", g.binary(Op::less, chosen, wide, true));
  g.output("product", product);
  g.output("same", g.invert(g.binary(Op::equal, a, b)));
  EXPECT_EQ(to_text(g),
            "graph words\n"
            "%0 = input:8 signed  a\n"
            "%1 = input:8  b\n"
            "%2 = input:1  bit\n"
            "%3 = extend:9 signed %0\n"
            "%4 = const:9 0x1ff\n"
            "%5 = sub:9 %3 %4  d @ hls/pipelines/toy.hpp:12\n"
            "%6 = slice:8 %5 [8:1]\n"
            "%7 = mul:16 signed %0 %6\n"
            "%8 = concat:9 %2 %1\n"
            "%9 = mux:9 %2 %8 %5 stage>=2\n"
            "%10 = cmp:1 signed %9 %3 stage>=2\n"
            "%11 = eq:1 %0 %1 stage>=2\n"
            "%12 = not:1 %11\n"
            "output less %10\n"
            "output product %7\n"
            "output same %12\n");
}

TEST(Graph, NamesEveryOperation) {
  EXPECT_EQ(op_name(Op::bit_and), "and");
  EXPECT_EQ(op_name(Op::bit_or), "or");
  EXPECT_EQ(op_name(Op::bit_xor), "xor");
  EXPECT_EQ(op_name(Op::add), "add");
}

TEST_F(Words, EqualNodesAreRecordedOnce) {
  const NodeId first = g.binary(Op::add, a, b);
  EXPECT_EQ(g.binary(Op::add, a, b), first);
  EXPECT_NE(g.binary(Op::add, b, a), first);
  EXPECT_NE(g.binary(Op::sub, a, b), first);
  EXPECT_EQ(g.constant(4, 0x3f), g.constant(4, 0xf)) << "constants wrap to their width";
  EXPECT_NE(g.constant(5, 0xf), g.constant(4, 0xf));
  EXPECT_NE(g.binary(Op::less, a, b, true), g.binary(Op::less, a, b, false));
  EXPECT_NE(g.input("c", 8, true), g.input("c", 8, true)) << "ports are never shared";
  const NodeId early = g.mux(bit, a, b);
  g.begin_stage(3);
  EXPECT_NE(g.mux(bit, a, b), early) << "a stated stage is part of what a node is";
  EXPECT_EQ(g.slice(a, 3, 0), g.slice(a, 3, 0));
}

TEST_F(Words, WiresThatChangeNothingAreNotRecorded) {
  const NodeId before = g.size();
  EXPECT_EQ(g.slice(a, 7, 0), a);
  EXPECT_EQ(g.extend(a, 8, true), a);
  EXPECT_EQ(g.resize(a, 8, false), a);
  EXPECT_EQ(g.mux(bit, a, a), a);
  EXPECT_EQ(g.size(), before);
  EXPECT_EQ(g.invert(g.invert(a)), a);
}

TEST_F(Words, ASliceLandsOnItsSource) {
  const NodeId part = g.slice(a, 6, 2);
  EXPECT_EQ(g.slice(part, 3, 1), g.slice(a, 5, 3)) << "of a slice";
  EXPECT_EQ(g.slice(g.constant(8, 0xa5), 7, 4), g.constant(4, 0xa)) << "of a constant";
  EXPECT_EQ(g.slice(g.invert(a), 4, 1), g.invert(g.slice(a, 4, 1))) << "of an inversion";

  const NodeId both = g.concat(a, b);
  EXPECT_EQ(g.slice(both, 5, 2), g.slice(b, 5, 2)) << "of the low half of a concatenation";
  EXPECT_EQ(g.slice(both, 15, 8), a) << "of the high half";
  EXPECT_EQ(g.slice(both, 9, 6), g.concat(g.slice(a, 1, 0), g.slice(b, 7, 6))) << "across";

  const NodeId sign = g.slice(a, 7, 7);
  const NodeId signed_12 = g.extend(a, 12, true);
  EXPECT_EQ(g.slice(signed_12, 6, 1), g.slice(a, 6, 1)) << "below an extension's sign";
  EXPECT_EQ(g.slice(signed_12, 9, 4), g.extend(g.slice(a, 7, 4), 6, true)) << "across it";
  EXPECT_EQ(g.slice(signed_12, 11, 9), g.extend(sign, 3, true)) << "above it";
  EXPECT_EQ(g.slice(signed_12, 11, 11), sign) << "one bit above it";
  const NodeId unsigned_12 = g.extend(a, 12, false);
  EXPECT_EQ(g.slice(unsigned_12, 9, 4), g.extend(g.slice(a, 7, 4), 6, false));
  EXPECT_EQ(g.slice(unsigned_12, 11, 9), g.constant(3, 0));
}

TEST_F(Words, ExtensionsAndConcatenationsMerge) {
  EXPECT_EQ(g.extend(g.extend(a, 10, true), 12, true), g.extend(a, 12, true));
  EXPECT_EQ(g.extend(g.extend(a, 10, false), 12, true), g.extend(a, 12, false)) << "the top bit is 0";
  const NodeId mixed = g.extend(g.extend(a, 10, true), 12, false);
  EXPECT_EQ(g[mixed].op, Op::extend);
  EXPECT_EQ(g[g[mixed].args[0]].op, Op::extend) << "the sign stops at bit 9";
  EXPECT_EQ(g.extend(g.constant(4, 0x9), 8, true), g.constant(8, 0xf9));
  EXPECT_EQ(g.extend(g.constant(4, 0x9), 8, false), g.constant(8, 0x09));
  EXPECT_EQ(g.concat(g.slice(a, 5, 3), g.slice(a, 2, 1)), g.slice(a, 5, 1)) << "adjacent bits";
  EXPECT_EQ(g.concat(g.slice(a, 7, 3), g.slice(a, 2, 0)), a);
  EXPECT_EQ(g[g.concat(g.slice(a, 5, 3), g.slice(a, 1, 0))].op, Op::concat) << "bits apart stay";
  EXPECT_EQ(g.resize(a, 5, true), g.slice(a, 4, 0));
  EXPECT_EQ(g.resize(a, 11, true), g.extend(a, 11, true));
}

TEST_F(Words, AValueKeepsItsFirstName) {
  const NodeId sum = g.binary(Op::add, a, b);
  g.annotate(sum, "", {"hls/x.hpp", 1});
  EXPECT_EQ(g[sum].source.line, 0U) << "no name, no source";
  g.annotate(sum, "first", {"hls/x.hpp", 2});
  g.annotate(sum, "second", {"hls/x.hpp", 3});
  EXPECT_EQ(g[sum].name, "first");
  EXPECT_EQ(g[sum].source.line, 2U);
  g.annotate(a, "other", {"hls/x.hpp", 4});
  EXPECT_EQ(g[a].name, "a") << "a port keeps its own";
}

TEST_F(Words, WrongWidthsRejected) {
  const NodeId two = g.slice(a, 1, 0);
  const NodeId wide = g.extend(g.input("port", 60, false), 120, false);
  const auto refusal = [](const auto& call) { return message_of<std::invalid_argument>(call); };
  const auto out_of_range = [](int width) {
    return fmt::format("graph words: a value of {} bits, allowed are 1 to 128", width);
  };
  for (const int width : {0, 129})
    EXPECT_EQ(refusal([&] { g.input("x", width, false); }), out_of_range(width));
  for (const int width : {0, 129}) EXPECT_EQ(refusal([&] { g.constant(width, 1); }), out_of_range(width));
  EXPECT_EQ(refusal([&] { g.extend(a, 129, true); }), out_of_range(129));
  EXPECT_EQ(refusal([&] { g.extend(a, 128, true); }), "no exception");
  EXPECT_EQ(refusal([&] { g.binary(Op::mul, wide, g.concat(a, bit)); }), out_of_range(129));
  EXPECT_EQ(refusal([&] { g.concat(wide, a); }), "no exception");
  EXPECT_EQ(refusal([&] { g.concat(wide, g.concat(a, bit)); }), out_of_range(129));
  EXPECT_EQ(refusal([&] { g.slice(a, 8, 3); }), "graph words: bits 8:3 of a 8-bit value");
  EXPECT_EQ(refusal([&] { g.slice(a, 3, -1); }), "graph words: bits 3:-1 of a 8-bit value");
  EXPECT_EQ(refusal([&] { g.slice(a, 2, 3); }), "graph words: bits 2:3 of a 8-bit value");
  EXPECT_EQ(refusal([&] { g.slice(a, 3, 3); }), "no exception");
  EXPECT_EQ(refusal([&] { g.binary(Op::add, a, bit); }),
            "graph words: add of 8 and 1 bits, the widths must be equal");
  EXPECT_EQ(refusal([&] { g.binary(Op::less, bit, a); }),
            "graph words: cmp of 1 and 8 bits, the widths must be equal");
  EXPECT_EQ(refusal([&] { g.binary(Op::mul, bit, a); }), "no exception");
  EXPECT_EQ(refusal([&] { g.mux(two, a, b); }), "graph words: mux of 8 and 8 bits by 2 bits");
  EXPECT_EQ(refusal([&] { g.mux(bit, a, two); }), "graph words: mux of 8 and 2 bits by 1 bits");
}

TEST_F(Words, WrongNumberOfInputsRejected) {
  const std::vector<std::uint64_t> two{1, 2};
  EXPECT_EQ(message_of<std::invalid_argument>([&] { return evaluate(g, two); }),
            "graph words: 2 input values for 3 inputs");
}

class EvaluatedRecipe : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Widest, EvaluatedRecipe, testing::Values(64, 65, 128));

TEST_P(EvaluatedRecipe, MeansWhatItsStepsSay) {
  constexpr int graphs = 400;
  constexpr int vectors = 50;
  Seeded random(101);
  int reached = 0;
  for (int i = 0; i < graphs; ++i) {
    const Recipe recipe(random, 5, 40, 6, GetParam());
    const Graph graph = recipe.graph();
    reached += graph.widest() == GetParam() ? 1 : 0;
    for (int v = 0; v < vectors; ++v) {
      const auto inputs = recipe.random_inputs(random);
      ASSERT_EQ(evaluate(graph, inputs), recipe.outputs(inputs)) << "graph " << i << "\n" << to_text(graph);
    }
  }
  EXPECT_GE(reached, GetParam() > 64 ? graphs / 10 : 0) << "graphs with a value of the greatest width";
}

TEST(Evaluate, RefusesPortsThatAProgramCannotHold) {
  Graph g("wide");
  const NodeId a = g.input("a", 64, false);
  const std::vector<std::uint64_t> one{1};
  g.output("o", g.extend(a, 65, true));
  EXPECT_EQ(message_of<std::invalid_argument>([&] { return evaluate(g, one); }),
            "graph wide: port o has 65 bits, evaluated are 1 to 64");
}

TEST(Evaluate, BitsAboveAPortAreIgnored) {
  Graph g("wrap");
  g.output("o", g.binary(Op::add, g.input("a", 4, false), g.constant(4, 1)));
  EXPECT_EQ(evaluate(g, std::vector<std::uint64_t>{0xf3}), std::vector<std::uint64_t>{4});
}

using Sources = std::vector<std::pair<NodeId, Word>>;

struct ReadWords : Words {
  [[nodiscard]] Sources of(NodeId value, Word bits) const {
    Sources found;
    for_each_source_of(g, value, bits, [&](NodeId source, Word read) { found.emplace_back(source, read); });
    return found;
  }
};

TEST(BitRange, IsAMask) {
  static_assert(bit_range(0, 0) == 1);
  static_assert(bit_range(7, 4) == 0xf0);
  static_assert(bit_range(63, 0) == ~std::uint64_t{0});
  static_assert(bit_range(63, 63) == std::uint64_t{1} << 63);
  static_assert(bit_range(127, 0) == ~Word{0});
  static_assert(bit_range(127, 64) == ~Word{0} << 64);
  EXPECT_EQ(bit_range(62, 1), ~std::uint64_t{0} >> 2 << 1);
}

TEST_F(ReadWords, WiresMoveTheBitsThatAreRead) {
  EXPECT_EQ(of(a, 0x0f), (Sources{{a, 0x0f}}));
  EXPECT_EQ(of(g.slice(a, 6, 2), 0x03), (Sources{{a, 0x0c}}));
  EXPECT_EQ(of(g.invert(a), 0x81), (Sources{{a, 0x81}}));
  const NodeId both = g.concat(a, b);
  EXPECT_EQ(of(both, 0x3c0), (Sources{{b, 0xc0}, {a, 0x03}}));
  EXPECT_EQ(of(both, 0x0f), (Sources{{b, 0x0f}})) << "nothing of the high half";
  EXPECT_EQ(of(both, 0xf00), (Sources{{a, 0x0f}})) << "nothing of the low half";
}

TEST_F(ReadWords, ASignExtensionReadsTheSign) {
  const NodeId wide = g.extend(a, 12, true);
  EXPECT_EQ(of(wide, 0x00f), (Sources{{a, 0x0f}}));
  EXPECT_EQ(of(wide, 0x801), (Sources{{a, 0x81}})) << "bit 11 is bit 7";
  EXPECT_EQ(of(wide, 0x300), (Sources{{a, 0x80}}));
}

TEST_F(ReadWords, ZerosAndConstantsReadNothing) {
  EXPECT_EQ(of(g.extend(b, 12, false), 0xf00), Sources{});
  EXPECT_EQ(of(g.extend(b, 12, false), 0xf01), (Sources{{b, 0x01}}));
  EXPECT_EQ(of(g.constant(8, 0xff), 0xff), Sources{});
  EXPECT_EQ(of(a, 0), Sources{});
}

TEST_F(ReadWords, OfANodeAreThoseOfItsOperands) {
  const NodeId node = g.mux(g.slice(a, 7, 7), g.slice(b, 3, 0), g.constant(4, 9));
  Sources found;
  for_each_source(g, node, [&](NodeId source, Word read) { found.emplace_back(source, read); });
  EXPECT_EQ(found, (Sources{{a, 0x80}, {b, 0x0f}}));
}

struct Caller : testing::Test {
  Graph g{"caller"};
  NodeId x = g.input("x", 4, false);
  NodeId y = g.input("y", 3, false);
};

/// 4-bit a - 2 b.
std::shared_ptr<const Submodule> less_twice(const std::string& name = "less_twice") {
  Graph body(name);
  const NodeId a = body.input("a", 4, false);
  const NodeId b = body.input("b", 3, false);
  body.output("r", body.binary(Op::sub, a, body.concat(b, body.constant(1, 0))));
  return std::make_shared<const Submodule>(Submodule{"int_subtract", 4, body});
}

TEST_F(Caller, HasTheValueOfItsBody) {
  g.output("o", g.invert(g.call(less_twice(), std::array{x, y})));
  for (std::uint64_t in_x = 0; in_x < 16; ++in_x)
    for (std::uint64_t in_y = 0; in_y < 8; ++in_y)
      EXPECT_EQ(evaluate(g, std::array{in_x, in_y}).front(), ~(in_x - 2 * in_y) & 15U) << in_x << ' ' << in_y;
}

TEST_F(Caller, ToTheSameUnitWithTheSameOperandsIsOneNode) {
  const NodeId first = g.call(less_twice(), std::array{x, y});
  EXPECT_EQ(g.call(less_twice(), std::array{x, y}), first) << "an equal unit of the same name is the same";
  EXPECT_NE(g.call(less_twice(), std::array{x, g.slice(x, 2, 0)}), first);
  EXPECT_NE(g.call(less_twice("other"), std::array{x, y}), first);
  ASSERT_EQ(g.submodules().size(), 2U);
  EXPECT_EQ(g.submodule_of(first)->body.name(), "less_twice");
}

TEST_F(Caller, ToADifferentUnitOfTheSameNameIsRejected) {
  const std::array operands{x, y};
  g.call(less_twice(), operands);
  const auto said = [&](const std::shared_ptr<const Submodule>& unit) {
    return message_of<std::invalid_argument>([&] { g.call(unit, operands); });
  };
  const std::string rejected = "graph caller: two different units have the name less_twice";

  Graph more("less_twice");
  const NodeId a = more.input("a", 4, false);
  const NodeId b = more.input("b", 3, false);
  more.output("r", more.binary(Op::add, a, more.concat(b, more.constant(1, 0))));
  EXPECT_EQ(said(std::make_shared<const Submodule>(Submodule{"int_subtract", 4, more})), rejected)
      << "another body";
  EXPECT_EQ(said(std::make_shared<const Submodule>(Submodule{"fp_subtract", 4, less_twice()->body})),
            rejected)
      << "another component";
  EXPECT_EQ(said(std::make_shared<const Submodule>(Submodule{"int_subtract", 5, less_twice()->body})),
            rejected)
      << "another width";
  EXPECT_EQ(said(less_twice()), "no exception") << "the same, traced again";
  EXPECT_EQ(g.submodules().size(), 1U);
}

TEST_F(Caller, PrintsItsUnitBelow) {
  const NodeId made = g.call(less_twice(), std::array{x, g.slice(x, 3, 1)});
  g.annotate(made, "made", {"here.hpp", 3});
  g.output("o", made);
  EXPECT_EQ(to_text(g),
            "graph caller\n"
            "%0 = input:4  x\n"
            "%1 = input:3  y\n"
            "%2 = slice:3 %0 [3:1]\n"
            "%3 = call:4 %0 %2 less_twice  made @ here.hpp:3\n"
            "output o %3\n"
            "graph less_twice\n"
            "%0 = input:4  a\n"
            "%1 = input:3  b\n"
            "%2 = const:1 0x0\n"
            "%3 = concat:4 %1 %2\n"
            "%4 = sub:4 %0 %3\n"
            "output r %4\n");
}

TEST_F(Caller, CanonicalKeepsLiveUnitsAndWholeOperands) {
  g.call(less_twice("dead"), std::array{x, y});
  const NodeId sum = g.binary(Op::add, x, x);
  g.output("o", g.slice(g.call(less_twice("live"), std::array{sum, y}), 0, 0));
  const Graph made = canonical(g);
  ASSERT_EQ(made.submodules().size(), 1U);
  EXPECT_EQ(made.submodules().front()->body.name(), "live");
  EXPECT_NE(to_text(made).find("add:4"), std::string::npos)
      << "one bit is read, all of the operand is needed";
  EXPECT_EQ(to_text(canonical(made)), to_text(made));
}

TEST_F(Caller, IsTheSourceOfItsBits) {
  const NodeId made = g.call(less_twice(), std::array{x, g.slice(x, 2, 0)});
  int sources = 0;
  for_each_source_of(g, g.slice(made, 2, 1), [&](NodeId source, Word bits) {
    EXPECT_EQ(source, made);
    EXPECT_EQ(bits, 6U);
    ++sources;
  });
  EXPECT_EQ(sources, 1);
}

TEST_F(Caller, WrongOperandsRejected) {
  EXPECT_EQ(message_of<std::invalid_argument>([&] {
              g.call(less_twice(), std::array{x, x});
            }),
            "graph caller: operand 1 of less_twice has 4 bits, not 3");
  EXPECT_EQ(
      message_of<std::invalid_argument>([&] { g.call(less_twice(), std::array{x}); }),
      "graph caller: less_twice takes 2 operands and gives 1 results, a call has 1 to 3 and 1; here are 1");
}

}  // namespace
}  // namespace hitpipe::rtl::graph_test
