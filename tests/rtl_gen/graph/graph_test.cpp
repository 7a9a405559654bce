// Recording, the peephole rules of wires, the text form, the messages; evaluate() against the plain meaning
// of the steps.
#include "rtl_gen/graph/graph.hpp"

#include <stdexcept>

#include <gtest/gtest.h>

#include "tests/message_of.hpp"
#include "tests/rtl_gen/graph/recipe.hpp"

namespace hitpipe::rtl::graph_test {
namespace {

struct Words {
  Graph g{"words"};
  NodeId a = g.input("a", 8, true);
  NodeId b = g.input("b", 8, false);
  NodeId bit = g.input("bit", 1, false);
};

TEST(Graph, PrintsOneLineANode) {
  Words w;
  const NodeId wide = w.g.extend(w.a, 9, true);
  const NodeId nine = w.g.constant(9, 0x1ff);
  const NodeId difference = w.g.binary(Op::sub, wide, nine);
  w.g.annotate(difference, "d", {"hls/pipelines/toy.hpp", 12});
  const NodeId product = w.g.binary(Op::mul, w.a, w.g.slice(difference, 8, 1), true);
  w.g.begin_stage(2);
  const NodeId chosen = w.g.mux(w.bit, w.g.concat(w.bit, w.b), difference);
  w.g.output("less", w.g.binary(Op::less, chosen, wide, true));
  w.g.output("product", product);
  w.g.output("same", w.g.invert(w.g.binary(Op::equal, w.a, w.b)));
  EXPECT_EQ(to_text(w.g),
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

TEST(Graph, EqualNodesAreRecordedOnce) {
  Words w;
  const NodeId first = w.g.binary(Op::add, w.a, w.b);
  EXPECT_EQ(w.g.binary(Op::add, w.a, w.b), first);
  EXPECT_NE(w.g.binary(Op::add, w.b, w.a), first);
  EXPECT_NE(w.g.binary(Op::sub, w.a, w.b), first);
  EXPECT_EQ(w.g.constant(4, 0x3f), w.g.constant(4, 0xf)) << "constants wrap to their width";
  EXPECT_NE(w.g.constant(5, 0xf), w.g.constant(4, 0xf));
  EXPECT_NE(w.g.binary(Op::less, w.a, w.b, true), w.g.binary(Op::less, w.a, w.b, false));
  EXPECT_NE(w.g.input("c", 8, true), w.g.input("c", 8, true)) << "ports are never shared";
  const NodeId early = w.g.mux(w.bit, w.a, w.b);
  w.g.begin_stage(3);
  EXPECT_NE(w.g.mux(w.bit, w.a, w.b), early) << "a stated stage is part of what a node is";
  EXPECT_EQ(w.g.slice(w.a, 3, 0), w.g.slice(w.a, 3, 0));
}

TEST(Graph, WiresThatChangeNothingAreNotRecorded) {
  Words w;
  const NodeId before = w.g.size();
  EXPECT_EQ(w.g.slice(w.a, 7, 0), w.a);
  EXPECT_EQ(w.g.extend(w.a, 8, true), w.a);
  EXPECT_EQ(w.g.resize(w.a, 8, false), w.a);
  EXPECT_EQ(w.g.mux(w.bit, w.a, w.a), w.a);
  EXPECT_EQ(w.g.size(), before);
  EXPECT_EQ(w.g.invert(w.g.invert(w.a)), w.a);
}

TEST(Graph, ASliceLandsOnItsSource) {
  Words w;
  const NodeId part = w.g.slice(w.a, 6, 2);
  EXPECT_EQ(w.g.slice(part, 3, 1), w.g.slice(w.a, 5, 3)) << "of a slice";
  EXPECT_EQ(w.g.slice(w.g.constant(8, 0xa5), 7, 4), w.g.constant(4, 0xa)) << "of a constant";
  EXPECT_EQ(w.g.slice(w.g.invert(w.a), 4, 1), w.g.invert(w.g.slice(w.a, 4, 1))) << "of an inversion";

  const NodeId both = w.g.concat(w.a, w.b);
  EXPECT_EQ(w.g.slice(both, 5, 2), w.g.slice(w.b, 5, 2)) << "of the low half of a concatenation";
  EXPECT_EQ(w.g.slice(both, 15, 8), w.a) << "of the high half";
  EXPECT_EQ(w.g.slice(both, 9, 6), w.g.concat(w.g.slice(w.a, 1, 0), w.g.slice(w.b, 7, 6))) << "across";

  const NodeId sign = w.g.slice(w.a, 7, 7);
  const NodeId signed_12 = w.g.extend(w.a, 12, true);
  EXPECT_EQ(w.g.slice(signed_12, 6, 1), w.g.slice(w.a, 6, 1)) << "below an extension's sign";
  EXPECT_EQ(w.g.slice(signed_12, 9, 4), w.g.extend(w.g.slice(w.a, 7, 4), 6, true)) << "across it";
  EXPECT_EQ(w.g.slice(signed_12, 11, 9), w.g.extend(sign, 3, true)) << "above it";
  EXPECT_EQ(w.g.slice(signed_12, 11, 11), sign) << "one bit above it";
  const NodeId unsigned_12 = w.g.extend(w.a, 12, false);
  EXPECT_EQ(w.g.slice(unsigned_12, 9, 4), w.g.extend(w.g.slice(w.a, 7, 4), 6, false));
  EXPECT_EQ(w.g.slice(unsigned_12, 11, 9), w.g.constant(3, 0));
}

TEST(Graph, ExtensionsAndConcatenationsMerge) {
  Words w;
  EXPECT_EQ(w.g.extend(w.g.extend(w.a, 10, true), 12, true), w.g.extend(w.a, 12, true));
  EXPECT_EQ(w.g.extend(w.g.extend(w.a, 10, false), 12, true), w.g.extend(w.a, 12, false))
      << "the top bit is 0";
  const NodeId mixed = w.g.extend(w.g.extend(w.a, 10, true), 12, false);
  EXPECT_EQ(w.g[mixed].op, Op::extend);
  EXPECT_EQ(w.g[w.g[mixed].args[0]].op, Op::extend) << "the sign stops at bit 9";
  EXPECT_EQ(w.g.extend(w.g.constant(4, 0x9), 8, true), w.g.constant(8, 0xf9));
  EXPECT_EQ(w.g.extend(w.g.constant(4, 0x9), 8, false), w.g.constant(8, 0x09));
  EXPECT_EQ(w.g.concat(w.g.slice(w.a, 5, 3), w.g.slice(w.a, 2, 1)), w.g.slice(w.a, 5, 1)) << "adjacent bits";
  EXPECT_EQ(w.g.concat(w.g.slice(w.a, 7, 3), w.g.slice(w.a, 2, 0)), w.a);
  EXPECT_EQ(w.g[w.g.concat(w.g.slice(w.a, 5, 3), w.g.slice(w.a, 1, 0))].op, Op::concat) << "bits apart stay";
  EXPECT_EQ(w.g.resize(w.a, 5, true), w.g.slice(w.a, 4, 0));
  EXPECT_EQ(w.g.resize(w.a, 11, true), w.g.extend(w.a, 11, true));
}

TEST(Graph, AValueKeepsItsFirstName) {
  Words w;
  const NodeId sum = w.g.binary(Op::add, w.a, w.b);
  w.g.annotate(sum, "", {"hls/x.hpp", 1});
  EXPECT_EQ(w.g[sum].source.line, 0U) << "no name, no source";
  w.g.annotate(sum, "first", {"hls/x.hpp", 2});
  w.g.annotate(sum, "second", {"hls/x.hpp", 3});
  EXPECT_EQ(w.g[sum].name, "first");
  EXPECT_EQ(w.g[sum].source.line, 2U);
  w.g.annotate(w.a, "other", {"hls/x.hpp", 4});
  EXPECT_EQ(w.g[w.a].name, "a") << "a port keeps its own";
}

TEST(Graph, WidthOutOfRangeRejected) {
  Words w;
  const auto input = [&](int width) {
    return [&w, width] { static_cast<void>(w.g.input("x", width, false)); };
  };
  EXPECT_EQ(message_of<std::invalid_argument>(input(0)),
            "graph words: a value of 0 bits, allowed are 1 to 64");
  EXPECT_EQ(message_of<std::invalid_argument>(input(65)),
            "graph words: a value of 65 bits, allowed are 1 to 64");
  EXPECT_EQ(message_of<std::invalid_argument>(input(64)), "no exception");
  const NodeId wide = w.g.input("wide", 60, false);
  EXPECT_EQ(message_of<std::invalid_argument>([&] { w.g.binary(Op::mul, wide, w.a); }),
            "graph words: a value of 68 bits, allowed are 1 to 64");
  EXPECT_EQ(message_of<std::invalid_argument>([&] { w.g.concat(wide, w.a); }),
            "graph words: a value of 68 bits, allowed are 1 to 64");
}

TEST(Graph, SliceOutsideTheValueRejected) {
  Words w;
  const auto slice = [&](int high, int low) {
    return message_of<std::invalid_argument>([&] { w.g.slice(w.a, high, low); });
  };
  EXPECT_EQ(slice(8, 3), "graph words: bits 8:3 of a 8-bit value");
  EXPECT_EQ(slice(3, -1), "graph words: bits 3:-1 of a 8-bit value");
  EXPECT_EQ(slice(2, 3), "graph words: bits 2:3 of a 8-bit value");
  EXPECT_EQ(slice(3, 3), "no exception");
}

TEST(Graph, UnequalWidthsRejected) {
  Words w;
  EXPECT_EQ(message_of<std::invalid_argument>([&] { w.g.binary(Op::add, w.a, w.bit); }),
            "graph words: add of 8 and 1 bits, the widths must be equal");
  EXPECT_EQ(message_of<std::invalid_argument>([&] { w.g.binary(Op::less, w.bit, w.a); }),
            "graph words: cmp of 1 and 8 bits, the widths must be equal");
  EXPECT_EQ(message_of<std::invalid_argument>([&] { w.g.binary(Op::mul, w.bit, w.a); }), "no exception");
}

TEST(Graph, MuxOfOtherWidthsRejected) {
  Words w;
  const NodeId two = w.g.slice(w.a, 1, 0);
  EXPECT_EQ(message_of<std::invalid_argument>([&] { w.g.mux(two, w.a, w.b); }),
            "graph words: mux of 8 and 8 bits by 2 bits");
  EXPECT_EQ(message_of<std::invalid_argument>([&] { w.g.mux(w.bit, w.a, two); }),
            "graph words: mux of 8 and 2 bits by 1 bits");
}

TEST(Evaluate, WrongNumberOfInputsRejected) {
  Words w;
  const std::vector<std::uint64_t> two{1, 2};
  EXPECT_EQ(message_of<std::invalid_argument>([&] { static_cast<void>(evaluate(w.g, two)); }),
            "graph words: 2 input values for 3 inputs");
}

TEST(Evaluate, RandomGraphsMeanWhatTheirStepsSay) {
  constexpr int graphs = 400;
  constexpr int vectors = 50;
  Seeded random(101);
  int compared = 0;
  for (int i = 0; i < graphs; ++i) {
    const Recipe recipe(random, 5, 40, 6);
    const Graph graph = recipe.graph();
    for (int v = 0; v < vectors; ++v, ++compared) {
      const auto inputs = recipe.random_inputs(random);
      ASSERT_EQ(evaluate(graph, inputs), recipe.outputs(inputs)) << "graph " << i << "\n" << to_text(graph);
    }
  }
  EXPECT_EQ(compared, graphs * vectors);
}

TEST(Evaluate, BitsAboveAPortAreIgnored) {
  Graph g("wrap");
  g.output("o", g.binary(Op::add, g.input("a", 4, false), g.constant(4, 1)));
  EXPECT_EQ(evaluate(g, std::vector<std::uint64_t>{0xf3}), std::vector<std::uint64_t>{4});
}

}  // namespace
}  // namespace hitpipe::rtl::graph_test
