// The schematic: every component, gate and register once, every reader connected where its operand belongs.
// Graphviz accepts it.
#include "rtl_gen/schematic/dot.hpp"

#include <algorithm>
#include <regex>
#include <sstream>
#include <utility>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "rtl_gen/emit/files.hpp"
#include "rtl_gen/verilog/names.hpp"
#include "tests/rtl_gen/catalogue/formats.hpp"
#include "tests/rtl_gen/component/unit_library.hpp"
#include "tests/rtl_gen/tool.hpp"
#include "tests/rtl_gen/verilog/toy.hpp"

namespace hitpipe::rtl::dot_test {
namespace {

/// Every stage in one drawing.
std::string drawn(const Pipeline& p, const std::vector<Port>& ports) {
  return to_dot(p, ports, "title", {1, p.schedule.stages});
}
std::string drawn(const Pipeline& p) {
  return drawn(p, input_ports(p.graph));
}

/// From which nodes to which the wires go, without the points where they enter.
std::vector<std::pair<std::string, std::string>> wires(const std::string& dot) {
  const std::regex edge("\n  ([a-z0-9_]+) -> ([a-z0-9_]+)[^\n]*");
  std::vector<std::pair<std::string, std::string>> found;
  for (std::sregex_iterator at(dot.begin(), dot.end(), edge); at != std::sregex_iterator(); ++at)
    if (at->str().find("style=invis") == std::string::npos) found.emplace_back((*at)[1], (*at)[2]);
  return found;
}

class Schematic : public testing::TestWithParam<DesignFormat> {};

TEST_P(Schematic, HasEveryRegisterWithItsWidth) {
  const Pipeline p = GetParam().pipeline();
  const std::string dot = drawn(p);
  int latches = 0;
  for (const Register& r : p.placement.registers) {
    if (r.boundary == 0) continue;
    const std::string node =
        fmt::format("\n  r{}_{}_{}_{} [label=\"L:{}\"", r.value, r.boundary, r.high, r.low, r.width());
    EXPECT_EQ(times(dot, node), 1) << node;
    ++latches;
  }
  EXPECT_EQ(times(dot, "label=\"L:"), latches);
}

TEST_P(Schematic, ConnectsOnlyWhatIsDrawn) {
  const std::string dot = drawn(GetParam().pipeline());
  const auto all = wires(dot);
  EXPECT_GT(all.size(), 45U);
  for (const auto& [from, to] : all)
    for (const std::string& end : {from, to}) EXPECT_EQ(times(dot, "\n  " + end + " ["), 1) << end;
}

/// Nodes that stand in one column, from the top.
std::vector<std::vector<NodeId>> columns(const std::string& dot) {
  const std::regex column("\n  \\{ rank=same ((?:v[0-9]+ )+)\\}");
  std::vector<std::vector<NodeId>> all;
  for (std::sregex_iterator at(dot.begin(), dot.end(), column); at != std::sregex_iterator(); ++at) {
    std::istringstream names((*at)[1].str());
    std::string name;
    all.emplace_back();
    while (names >> name) all.back().push_back(static_cast<NodeId>(std::stoul(name.substr(1))));
  }
  return all;
}

TEST_P(Schematic, HasTheAxesFromTopToBottomInEveryColumn) {
  const Pipeline p = GetParam().pipeline();
  const std::vector<Port> ports = GetParam().found().ports(GetParam().parsed());
  const std::vector<double> places = axis_order(p.graph, ports);
  const std::string dot = drawn(p, ports);
  std::size_t nodes = 0;
  for (const std::vector<NodeId>& column : columns(dot)) {
    nodes += column.size();
    for (std::size_t i = 1; i < column.size(); ++i) {
      EXPECT_LE(places[column[i - 1]], places[column[i]]) << column[i];
      EXPECT_EQ(times(dot, fmt::format("\n  v{} -> v{} [style=invis]", column[i - 1], column[i])), 1);
    }
  }
  EXPECT_GE(nodes, 25U);
}

// A group has the nodes of its own stages and labels by name what enters it.
TEST_P(Schematic, GroupsOfStagesShareOutTheWholeAndNameWhatComesIn) {
  const Pipeline p = GetParam().pipeline();
  const std::vector<ValueName> names = value_names(p.graph, p.placement, {});
  int next = 1;
  for (const StageRange& group : stage_groups(p)) {
    EXPECT_EQ(group.first, next);
    EXPECT_GE(group.last, group.first);
    const std::string part = to_dot(p, input_ports(p.graph), "part", group);
    const auto inside = [&](int stage) { return stage >= group.first && stage <= group.last; };
    for (NodeId id = 0; id < p.graph.size(); ++id) {
      const bool drawn = is_root(p.graph[id].op) && inside(p.schedule.slots[id].stage);
      EXPECT_EQ(times(part, fmt::format("\n  v{} [", id)), drawn ? 1 : 0) << "%" << id;
    }
    for (const Register& r : p.placement.registers) {
      const std::string node = fmt::format("\n  r{}_{}_{}_{} [", r.value, r.boundary, r.high, r.low);
      EXPECT_EQ(times(part, node), inside(r.boundary) ? 1 : 0) << node;
    }
    for (const Output& output : p.graph.outputs())
      EXPECT_EQ(times(part, "\n  out_" + output.name + " ["), group.last == p.schedule.stages ? 1 : 0)
          << output.name;
    for (const Register& r : p.placement.registers)
      if (r.boundary == group.first - 1) {
        EXPECT_GE(times(part, fmt::format("[label=\"{}\" shape=plaintext", names[r.value].name)), 1)
            << names[r.value].name;
      }
    for (const auto& [from, to] : wires(part))
      for (const std::string& end : {from, to}) EXPECT_EQ(times(part, "\n  " + end + " ["), 1) << end;
    next = group.last + 1;
  }
  EXPECT_EQ(next, p.schedule.stages + 1);
}

TEST(SchematicGroups, AreTheThesissFigures) {
  const auto groups_of = [](const std::string& design, const std::string& format) {
    std::string text;
    for (const StageRange& g : stage_groups(DesignFormat{design, format}.pipeline()))
      text += fmt::format("{}-{} ", g.first, g.last);
    return text;
  };
  EXPECT_EQ(groups_of("fp_slabs", "fp32"), "1-7 8-12 13-13 ");
  EXPECT_EQ(groups_of("int_slabs", "24/24"), "1-1 2-4 5-5 ");
  EXPECT_EQ(groups_of("fp_plucker", "fp32"), "1-7 8-12 13-19 20-20 ");
  EXPECT_EQ(groups_of("int_plucker", "24/24"), "1-1 2-4 5-5 ");
}

INSTANTIATE_TEST_SUITE_P(Designs, Schematic, testing::ValuesIn(every_design()), design_suffix);

TEST(ToySchematic, DrawsSignsAndInversions) {
  const std::string dot = to_dot(toy_pipeline(), {}, "toy 6/6", {1, 5});
  EXPECT_EQ(times(dot, "label=\"toy 6/6\""), 1);
  EXPECT_EQ(times(dot, "  r3_4_5_5 -> v10:sw [ label=\"sign\" style=dashed]\n"), 1)
      << "the difference's sign";
  EXPECT_EQ(times(dot, " -> v5:0:w [ arrowhead=odot]\n"), 1) << "an inverted operand";
  EXPECT_EQ(times(dot, "  r11_5_0_0 -> out_hit [ arrowhead=odot]\n"), 1) << "an inverted output";
  EXPECT_EQ(times(dot, "tooltip=\"toy_cmp\""), 1);
}

TEST(ToySchematic, EveryOperandIsAnEdge) {
  const Pipeline p = toy_pipeline();
  std::vector<int> edges(p.graph.size(), 0);
  for (const auto& [from, to] : wires(drawn(p)))
    if (to.starts_with("v")) ++edges[static_cast<std::size_t>(std::stoi(to.substr(1)))];
  for (NodeId id = 0; id < p.graph.size(); ++id)
    EXPECT_EQ(edges[id], is_root(p.graph[id].op) ? p.graph[id].arity() : 0) << "%" << id;
}

TEST(ToySchematic, GraphvizDrawsIt) {
  const std::string dot = drawn(toy_pipeline());
  const File svg = draw({{"toy.dot", dot}}).value().front();
  EXPECT_EQ(times(svg.contents, ">L:6</text>"), times(dot, "label=\"L:6\""));
  EXPECT_EQ(times(svg.contents, ">stage 5</text>"), 1);
}

/// One comparison, sum or choice of operands x0, x1, ... whose axes are x, y, z, none, ...
struct Small {
  Graph graph{"small"};
  std::vector<Port> ports;

  NodeId operand(hls::Axis axis, int width = 8) {
    const std::string name = fmt::format("x{}", ports.size());
    ports.push_back({.name = name, .width = width, .is_signed = width > 1, .axis = axis});
    return graph.input(name, width, width > 1);
  }
  std::string dot(NodeId result) {
    graph.output("hit", result);
    return drawn(make_pipeline(graph, unit_library()), ports);
  }
};

/// The label of the node that enters another at this point.
std::string entering(const std::string& dot, const std::string& point) {
  std::smatch wire;
  if (!std::regex_search(dot, wire, std::regex("\n  (in[0-9]+) -> v[0-9]+:" + point + " "))) return "";
  std::smatch label;
  std::regex_search(dot, label, std::regex("\n  " + wire[1].str() + " \\[label=\"([^\"]*)\""));
  return label[1];
}

TEST(SmallSchematic, AComparatorSaysWhatItTellsOfTheUpperOperand) {
  for (const bool x_first : {true, false}) {
    Small s;
    const NodeId x = s.operand(hls::Axis::x), y = s.operand(hls::Axis::y);
    const std::string dot = s.dot(s.graph.binary(Op::less, x_first ? x : y, x_first ? y : x, true));
    EXPECT_EQ(entering(dot, "nw"), "x0");
    EXPECT_EQ(entering(dot, "sw"), "x1");
    EXPECT_EQ(times(dot, x_first ? "[label=\"<\" shape=circle" : "[label=\">\" shape=circle"), 1);
  }
}

TEST(SmallSchematic, ADifferenceIsTheUpperOperandLessTheLower) {
  Small s;
  const NodeId x = s.operand(hls::Axis::x);
  const NodeId y = s.operand(hls::Axis::y);
  const std::string dot = s.dot(s.graph.binary(Op::sub, y, x));
  EXPECT_EQ(entering(dot, "nw"), "x1");
  EXPECT_EQ(entering(dot, "sw"), "x0");
}

TEST(SmallSchematic, TheArmsOfAMultiplexerAreNumbered) {
  for (const bool x_is_one : {true, false}) {
    Small s;
    const NodeId x = s.operand(hls::Axis::x), y = s.operand(hls::Axis::y);
    const NodeId select = s.operand(hls::Axis::none, 1);
    const std::string dot = s.dot(s.graph.mux(select, x_is_one ? x : y, x_is_one ? y : x));
    EXPECT_EQ(entering(dot, "1:w"), x_is_one ? "x0" : "x1");
    EXPECT_EQ(entering(dot, "0:w"), x_is_one ? "x1" : "x0");
    EXPECT_EQ(entering(dot, "s:w"), "x2");
    EXPECT_EQ(dot.find("port=\"1\"") < dot.find("port=\"0\""), x_is_one) << "the arm of x is on top";
  }
}

TEST(SmallSchematic, AConstantIsALabelledSource) {
  Small s;
  const NodeId x = s.operand(hls::Axis::x);
  const NodeId bound = s.graph.constant(8, 0xf0);
  s.graph.annotate(bound, "BOUND", {});
  EXPECT_EQ(entering(s.dot(s.graph.binary(Op::less, x, bound, true)), "sw"), "BOUND = -16");
  Small t;
  const std::string dot = t.dot(t.graph.binary(Op::less, t.graph.constant(8, 0xf0), t.operand(hls::Axis::x)));
  EXPECT_EQ(entering(dot, "sw"), "240") << "unsigned, without a name, and below";
  EXPECT_EQ(times(dot, "[label=\">\" shape=circle"), 1);
}

TEST(SmallSchematic, EbndOfPlueckerIsDrawnAtEachSide) {
  const DesignFormat d{"int_plucker", "20/24"};
  EXPECT_EQ(times(drawn(d.pipeline()), "label=\"EBND = -16\""), 6);
}

TEST(SmallSchematic, AFloatComparatorNamesTheResultsThatAreUsed) {
  const DesignFormat d{"fp_slabs", "fp32"};
  const std::string dot = drawn(d.pipeline(), d.found().ports(d.parsed()));
  EXPECT_EQ(times(dot, "label=\"<\" shape=circle") + times(dot, "label=\">\" shape=circle"), 6);
  EXPECT_EQ(times(dot, "<>"), 0);
}

TEST(AxisOrder, IsTheMeanOfWhatAValueIsMadeOf) {
  Small s;
  const NodeId x = s.operand(hls::Axis::x);
  const NodeId z = s.operand(hls::Axis::z);
  const NodeId length = s.operand(hls::Axis::none);
  const NodeId between = s.graph.binary(Op::add, x, z);
  const NodeId ended = s.graph.binary(Op::less, between, length);
  const NodeId lengths = s.graph.binary(Op::add, length, length);
  const std::vector<double> places = axis_order(s.graph, s.ports);
  EXPECT_EQ(places[x], 1.0);
  EXPECT_EQ(places[z], 3.0);
  EXPECT_EQ(places[between], 2.0);
  EXPECT_EQ(places[ended], 2.0);
  EXPECT_EQ(places[lengths], 4.0);
}

}  // namespace
}  // namespace hitpipe::rtl::dot_test
