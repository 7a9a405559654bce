// Names in the Verilog: as in the C++ if possible, never a keyword, never one name for two things.
#include "rtl_gen/verilog/names.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "rtl_gen/graph/canonical.hpp"
#include "rtl_gen/verilog/module.hpp"
#include "tests/rtl_gen/component/unit_library.hpp"
#include "tests/rtl_gen/tool.hpp"

namespace hitpipe::rtl::names_test {
namespace {

struct Tiny {
  Graph g{"tiny"};
  NodeId a = g.input("a", 8, true);
  NodeId b = g.input("b", 8, true);

  NodeId named(const char* name, NodeId node) {
    g.annotate(node, name, {});
    return node;
  }
  [[nodiscard]] std::vector<std::string> names(std::set<std::string> taken = {}) const {
    const Placement placement = place_registers(g, schedule_asap(g, unit_library()), Ports::latched);
    std::vector<std::string> names;
    for (const ValueName& value : value_names(g, placement, std::move(taken))) names.push_back(value.name);
    return names;
  }
};

TEST(Names, AreThoseOfTheCpp) {
  Tiny t;
  const NodeId d = t.named("d_near_x", t.g.binary(Op::sub, t.a, t.b));
  t.g.output("o", d);
  EXPECT_EQ(t.names(), (std::vector<std::string>{"a", "b", "d_near_x"}));
}

TEST(Names, KeywordsGetANumber) {
  for (const char* keyword :
       {"reg", "wire", "always", "casez", "endmodule", "event", "supply0", "release", "table", "design",
        "cross", "inside", "logic", "with", "within", "unique0", "string"}) {
    Tiny t;
    t.g.output("o", t.named(keyword, t.g.binary(Op::sub, t.a, t.b)));
    EXPECT_EQ(t.names().back(), std::string(keyword) + "_2");
  }
}

TEST(Names, CollisionsGetANumberAndPortsKeepTheirs) {
  Tiny t;
  const NodeId first = t.named("d", t.g.binary(Op::sub, t.a, t.b));
  const NodeId second = t.named("d", t.g.binary(Op::sub, t.b, t.a));
  const NodeId third = t.named("b", t.g.binary(Op::sub, first, second));
  const NodeId fourth = t.named("advance", t.g.binary(Op::sub, third, t.a));
  t.g.output("o", t.named("d_2", t.g.binary(Op::sub, fourth, t.b)));
  EXPECT_EQ(t.names({"advance"}),
            (std::vector<std::string>{"a", "b", "d", "d_2", "b_2", "advance_2", "d_2_2"}));
}

TEST(Names, ATrimmedProductTakesTheNameOfItsPart) {
  Tiny t;
  const NodeId product = t.g.binary(Op::mul, t.a, t.b, true);
  t.g.output("o", t.named("distance", t.g.slice(product, 14, 7)));
  EXPECT_EQ(t.names().at(product), "distance");
}

TEST(Names, AProductThatIsReadBesideItsPartDoesNot) {
  Tiny t;
  const NodeId product = t.g.binary(Op::mul, t.a, t.b, true);
  t.g.output("o", t.named("distance", t.g.slice(product, 14, 7)));
  t.g.output("low", t.g.slice(product, 0, 0));
  EXPECT_EQ(t.names().at(product), "distance_mul") << "after its first named reader";
}

TEST(Names, APartKeepsItsNameWhereFewerOfItsBitsAreRead) {
  Tiny t;
  const NodeId product = t.g.binary(Op::mul, t.a, t.b, true);
  t.named("product", t.g.slice(product, 14, 0));
  const NodeId distance = t.named("distance", t.g.slice(product, 14, 7));
  t.g.output("o", t.g.slice(distance, 6, 1));
  EXPECT_EQ(t.names().at(product), "distance") << "the smallest part that holds bits 13:8";
  const Graph made = canonical(t.g);
  const Placement placement = place_registers(made, schedule_asap(made, unit_library()), Ports::latched);
  EXPECT_EQ(value_names(made, placement, {}).at(2).name, "distance");
}

TEST(Names, AnExtendedValueHasTheNameOfTheExtension) {
  Tiny t;
  const NodeId sum = t.g.binary(Op::add, t.a, t.b);
  t.g.output("o", t.named("wide", t.g.extend(sum, 12, true)));
  EXPECT_EQ(t.names().at(sum), "wide");
}

TEST(Names, ASignDoesNotNameItsValue) {
  Tiny t;
  const NodeId sum = t.g.binary(Op::add, t.a, t.b);
  t.g.output("o", t.named("negative", t.g.slice(sum, 7, 7)));
  t.g.output("p", t.named("all", t.g.binary(Op::bit_xor, sum, t.b)));
  EXPECT_EQ(t.names().at(sum), "tiny_add");
}

TEST(Names, AValueOfSeveralReadersTakesTheWordsThatTheyShare) {
  Tiny t;
  const NodeId sum = t.g.binary(Op::add, t.a, t.b);
  const NodeId near = t.g.binary(Op::bit_xor, sum, t.b);
  t.g.output("o", t.named("d_near_x", near));
  t.g.output("p", t.named("d_far_x", t.g.binary(Op::bit_or, sum, t.b)));
  EXPECT_EQ(t.names().at(sum), "d_x_add");
}

TEST(Names, ALineIsOfTheValueOrOfTheOnlyLineItIsFor) {
  Tiny t;
  const NodeId shared = t.g.binary(Op::add, t.a, t.b);
  const NodeId inner = t.g.binary(Op::bit_and, shared, t.b);
  const NodeId first = t.g.binary(Op::bit_xor, inner, t.a);
  const NodeId second = t.g.binary(Op::bit_or, shared, t.b);
  t.g.annotate(first, "first", {"hls/pipelines/tiny.hpp", 4});
  t.g.annotate(second, "second", {"hls/pipelines/tiny.hpp", 5});
  t.g.output("o", first);
  t.g.output("p", second);
  const Placement placement = place_registers(t.g, schedule_asap(t.g, unit_library()), Ports::latched);
  const auto names = value_names(t.g, placement, {});
  EXPECT_EQ(names.at(first).source.line, 4);
  EXPECT_TRUE(names.at(first).is_own);
  EXPECT_EQ(names.at(inner).source.line, 4);
  EXPECT_FALSE(names.at(inner).is_own);
  EXPECT_EQ(names.at(shared).source.line, 0) << "it is for two lines";
}

TEST(Names, UnnamedValuesAreCalledAfterTheirReader) {
  Tiny t;
  const NodeId less = t.g.binary(Op::less, t.a, t.b, true);
  const NodeId gate = t.g.binary(Op::bit_and, less, t.g.slice(t.a, 0, 0));
  t.g.output("o", t.named("chosen", t.g.mux(t.g.invert(gate), t.a, t.b)));
  const NodeId nameless = t.g.binary(Op::bit_or, t.a, t.b);
  t.g.output("p", nameless);
  const auto names = t.names();
  EXPECT_EQ(names.at(less), "chosen_cmp");
  EXPECT_EQ(names.at(gate), "chosen_and");
  EXPECT_EQ(names.at(nameless), "tiny_or") << "after the graph";
  EXPECT_EQ(names.at(t.g.invert(gate)), "") << "wires have no name";
}

/// What Verilator and Icarus report about a graph's Verilog.
std::string complaints(const Graph& graph) {
  const ScratchFolder folder;
  const Library library = unit_library();
  write_text(folder / "tiny.v", to_verilog(make_pipeline(graph, library), library));
  return run_tool(folder.path(), "verilator", "verilator", "--lint-only -Wall tiny.v").output +
         run_tool(folder.path(), "iverilog", "iverilog", "-g2001 -Wall -o tiny tiny.v").output;
}

TEST(Names, AValueMayBeCalledAsAnotherOnesRegister) {
  Tiny t;
  const NodeId d = t.named("d", t.g.binary(Op::sub, t.a, t.b));
  const NodeId e = t.named("d_s1", t.g.binary(Op::bit_xor, d, t.b));
  const NodeId f = t.named("d_sign_s2", t.g.binary(Op::sub, e, t.b));
  const NodeId h = t.named("mul_p", t.g.binary(Op::sub, f, t.b));
  const NodeId p = t.named("p", t.g.slice(t.g.binary(Op::mul, h, t.b, true), 14, 7));
  t.g.output("o", t.g.binary(Op::bit_xor, t.named("unused", t.g.binary(Op::sub, p, t.b)), t.a));
  t.g.output("sign", t.g.slice(d, 7, 7));
  EXPECT_EQ(complaints(t.g), "");
}

TEST(Names, ValuesMayBeCalledAsTheHandshake) {
  Tiny t;
  NodeId last = t.a;
  for (const char* name :
       {"clk", "rst", "in_valid", "in_ready", "in_tag", "out_valid", "out_ready", "out_tag", "advance",
        "valid", "TAG_BITS", "tag_s0", "tag_s1", "o", "cross", "release"}) {
    last = t.named(name, t.g.binary(Op::bit_xor, t.b, t.g.binary(Op::bit_and, last, t.b)));
  }
  t.g.output("o", last);
  EXPECT_EQ(complaints(t.g), "");
}

}  // namespace
}  // namespace hitpipe::rtl::names_test
