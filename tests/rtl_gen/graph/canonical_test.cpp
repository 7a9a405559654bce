// canonical(): what it removes and narrows. It keeps the meaning, and a second run changes nothing.
#include "rtl_gen/graph/canonical.hpp"

#include <gtest/gtest.h>

#include "tests/rtl_gen/graph/recipe.hpp"

namespace hitpipe::rtl::canonical_test {
namespace {

TEST(Canonical, DeadNodesGoAndInputsStay) {
  Graph g("dead");
  const NodeId a = g.input("a", 8, true);
  const NodeId b = g.input("b", 8, true);
  g.binary(Op::mul, a, b, true);
  const NodeId used = g.binary(Op::less, a, a, true);
  g.input("unread", 3, false);
  g.output("o", used);
  EXPECT_EQ(to_text(canonical(g)),
            "graph dead\n"
            "%0 = input:8 signed  a\n"
            "%1 = input:8 signed  b\n"
            "%2 = input:3  unread\n"
            "%3 = cmp:1 signed %0 %0\n"
            "output o %3\n");
}

TEST(Canonical, ArithmeticIsNoWiderThanWhatIsRead) {
  Graph g("narrow");
  const NodeId a = g.input("a", 8, true);
  const NodeId b = g.input("b", 8, true);
  const NodeId c = g.input("c", 1, false);
  const NodeId wide_a = g.extend(a, 9, true);
  const NodeId difference = g.binary(Op::sub, wide_a, g.extend(b, 9, true));
  g.annotate(difference, "d", {});
  const NodeId chosen = g.mux(c, difference, wide_a);
  g.output("low", g.slice(chosen, 5, 0));
  EXPECT_EQ(to_text(canonical(g)),
            "graph narrow\n"
            "%0 = input:8 signed  a\n"
            "%1 = input:8 signed  b\n"
            "%2 = input:1  c\n"
            "%3 = slice:6 %0 [5:0]\n"
            "%4 = slice:6 %1 [5:0]\n"
            "%5 = sub:6 %3 %4  d\n"
            "%6 = mux:6 %2 %5 %3\n"
            "output low %6\n");
}

TEST(Canonical, MultipliersAndComparatorsStayWhole) {
  Graph g("whole");
  const NodeId a = g.input("a", 8, true);
  const NodeId b = g.input("b", 8, true);
  const NodeId sum = g.binary(Op::add, g.extend(a, 9, true), g.extend(b, 9, true));
  const NodeId product = g.binary(Op::mul, sum, a, true);
  g.output("low", g.slice(product, 3, 0));
  g.output("less", g.binary(Op::less, sum, g.extend(b, 9, true), true));
  EXPECT_EQ(to_text(canonical(g)),
            "graph whole\n"
            "%0 = input:8 signed  a\n"
            "%1 = input:8 signed  b\n"
            "%2 = extend:9 signed %0\n"
            "%3 = extend:9 signed %1\n"
            "%4 = add:9 %2 %3\n"
            "%5 = mul:17 signed %4 %0\n"
            "%6 = slice:4 %5 [3:0]\n"
            "%7 = cmp:1 signed %4 %3\n"
            "output low %6\n"
            "output less %7\n");
}

TEST(Canonical, StatedStagesStay) {
  Graph g("stated");
  const NodeId a = g.input("a", 8, true);
  g.begin_stage(2);
  g.output("o", g.binary(Op::add, a, a));
  EXPECT_EQ(to_text(canonical(g)),
            "graph stated\n"
            "%0 = input:8 signed  a\n"
            "%1 = add:8 %0 %0 stage>=2\n"
            "output o %1\n");
}

// The arms differ only in bits that nobody reads. The mux is removed, and also the logic that only served to
// choose.
TEST(Canonical, WhatOnlyAVanishedMuxReadGoes) {
  Graph g("vanished");
  const NodeId a = g.input("a", 4, true);
  const NodeId b = g.input("b", 4, true);
  const NodeId choose = g.binary(Op::less, a, b, true);
  const NodeId chosen = g.mux(choose, g.extend(a, 8, true), g.extend(a, 8, false));
  g.output("o", g.slice(chosen, 3, 0));
  EXPECT_EQ(to_text(canonical(g)),
            "graph vanished\n"
            "%0 = input:4 signed  a\n"
            "%1 = input:4 signed  b\n"
            "output o %0\n");
}

bool every_node_is_read(const Graph& graph) {
  std::vector<bool> read(graph.size(), false);
  for (const Output& out : graph.outputs()) read[out.node] = true;
  for (NodeId id = graph.size(); id-- > 0;) {
    if (!read[id] && graph[id].op != Op::input) return false;
    for (const NodeId arg : graph[id].operands()) read[arg] = true;
  }
  return true;
}

TEST(Canonical, RandomGraphsKeepTheirMeaning) {
  constexpr int graphs = 600;
  constexpr int vectors = 20;
  Seeded random(107);
  int smaller = 0;
  for (int i = 0; i < graphs; ++i) {
    const Recipe recipe(random, 5, 60, 4);
    const Graph graph = recipe.graph();
    const Graph made = canonical(graph);
    smaller += made.size() < graph.size() ? 1 : 0;
    ASSERT_TRUE(every_node_is_read(made)) << "graph " << i << "\n" << to_text(graph) << to_text(made);
    for (int v = 0; v < vectors; ++v) {
      const auto inputs = recipe.random_inputs(random);
      ASSERT_EQ(evaluate(made, inputs), recipe.outputs(inputs)) << "graph " << i << "\n"
                                                                << to_text(graph) << to_text(made);
    }
  }
  EXPECT_GT(smaller, graphs / 2);
}

TEST(Canonical, IsIdempotent) {
  constexpr int graphs = 600;
  Seeded random(109);
  for (int i = 0; i < graphs; ++i) {
    const Graph graph = Recipe(random, 5, 60, 4).graph();
    const Graph once = canonical(graph);
    ASSERT_EQ(to_text(canonical(once)), to_text(once)) << "graph " << i << "\n" << to_text(graph);
  }
}

TEST(Canonical, DoesNotDependOnTheOrderOfRecording) {
  constexpr int graphs = 300;
  Seeded random(113);
  int reordered = 0;
  for (int i = 0; i < graphs; ++i) {
    const Recipe recipe(random, 5, 50, 4);
    const Graph graph = recipe.graph();
    const Graph other = recipe.shuffled(random);
    reordered += to_text(other) != to_text(graph) ? 1 : 0;
    ASSERT_EQ(to_text(canonical(other)), to_text(canonical(graph))) << "graph " << i << "\n"
                                                                    << to_text(graph);
  }
  EXPECT_EQ(reordered, graphs) << "a shuffle that changes nothing tests nothing";
}

}  // namespace
}  // namespace hitpipe::rtl::canonical_test
