// The schematic: every component, gate and register once, every reader connected. Graphviz accepts it.
#include "rtl_gen/schematic/dot.hpp"

#include <algorithm>
#include <regex>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "rtl_gen/emit/files.hpp"
#include "rtl_gen/verilog/names.hpp"
#include "tests/rtl_gen/catalogue/formats.hpp"
#include "tests/rtl_gen/tool.hpp"
#include "tests/rtl_gen/verilog/toy.hpp"

namespace hitpipe::rtl {
namespace {

int times(const std::string& text, const std::string& part) {
  int count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

/// The text of one cluster.
std::string cluster(const std::string& dot, const std::string& name) {
  const std::size_t begin = dot.find("subgraph cluster_" + name + " {");
  if (begin == std::string::npos) return "";
  return dot.substr(begin, dot.find("\n  }", begin) - begin);
}

std::string cluster_of_stage(const std::string& dot, int stage) {
  return cluster(dot, stage == 0 ? "inputs" : fmt::format("stage_{}", stage));
}

class Schematic : public testing::TestWithParam<DesignFormat> {};

TEST_P(Schematic, HasEveryComponentGateAndPortOnceInItsStage) {
  const Pipeline p = GetParam().pipeline();
  const std::string dot = to_dot(p, "title");
  int drawn = 0;
  for (NodeId id = 0; id < p.graph.size(); ++id) {
    const std::string node = fmt::format("\n    v{} [", id);
    EXPECT_EQ(times(dot, node), is_root(p.graph[id].op) ? 1 : 0) << "%" << id;
    if (!is_root(p.graph[id].op)) continue;
    EXPECT_EQ(times(cluster_of_stage(dot, p.schedule.slots[id].stage), node), 1) << "%" << id;
    ++drawn;
  }
  if (GetParam().design == "int_slabs") {
    EXPECT_EQ(drawn, 17 + 6 + 16 + 6 + 6 + 3) << "ports, subtractors, muxes, multipliers, comparators, gates";
  }
  EXPECT_GE(drawn, 45);
}

TEST_P(Schematic, HasEveryRegisterOnceInItsStageWithItsWidth) {
  const Pipeline p = GetParam().pipeline();
  const std::string dot = to_dot(p, "title");
  for (const Register& r : p.placement.registers) {
    const std::string node =
        fmt::format("\n    r{}_{}_{}_{} [label=\"L:{}\"", r.value, r.boundary, r.high, r.low, r.width());
    EXPECT_EQ(times(dot, node), 1) << node;
    EXPECT_EQ(times(cluster_of_stage(dot, r.boundary), node), 1) << node;
  }
  EXPECT_EQ(times(dot, "label=\"L:"), static_cast<int>(p.placement.registers.size()));
}

TEST_P(Schematic, ConnectsOnlyWhatIsDrawn) {
  const Pipeline p = GetParam().pipeline();
  const std::string dot = to_dot(p, "title");
  const std::regex edge("\n  ([a-z0-9_]+) -> ([a-z0-9_]+)");
  int edges = 0;
  for (std::sregex_iterator at(dot.begin(), dot.end(), edge); at != std::sregex_iterator(); ++at, ++edges) {
    for (const std::size_t end : {1U, 2U}) {
      EXPECT_EQ(times(dot, "  " + (*at)[end].str() + " ["), 1) << (*at)[end].str();
    }
  }
  EXPECT_GT(edges, 0);
}

// A group has the nodes of its own stages and labels by name what enters it.
TEST_P(Schematic, GroupsOfStagesShareOutTheWhole) {
  const Pipeline p = GetParam().pipeline();
  int next = 1;
  for (const StageRange& group : stage_groups(p)) {
    EXPECT_EQ(group.first, next);
    EXPECT_GE(group.last, group.first);
    const std::string part = to_dot(p, "part", group);
    const auto inside = [&](int stage) { return stage >= group.first && stage <= group.last; };
    for (NodeId id = 0; id < p.graph.size(); ++id) {
      const bool drawn = is_root(p.graph[id].op) && inside(p.schedule.slots[id].stage);
      EXPECT_EQ(times(part, fmt::format("\n  v{} [", id)), drawn ? 1 : 0) << "%" << id;
    }
    for (const Register& r : p.placement.registers) {
      const std::string node = fmt::format("\n    r{}_{}_{}_{} [", r.value, r.boundary, r.high, r.low);
      EXPECT_EQ(times(part, node), inside(r.boundary) ? 1 : 0) << node;
    }
    for (const Output& output : p.graph.outputs())
      EXPECT_EQ(times(part, "\n  out_" + output.name + " ["), group.last == p.schedule.stages ? 1 : 0)
          << output.name;
    next = group.last + 1;
  }
  EXPECT_EQ(next, p.schedule.stages + 1);
}

TEST_P(Schematic, GroupsNameWhatComesIn) {
  const Pipeline p = GetParam().pipeline();
  const std::vector<std::string> names = value_names(p.graph, p.placement, {});
  for (const StageRange& group : stage_groups(p)) {
    const std::string part = to_dot(p, "part", group);
    for (const Register& r : p.placement.registers) {
      if (r.boundary != group.first - 1) continue;
      EXPECT_GE(times(part, fmt::format("[label=\"{}\" shape=plaintext", names[r.value])), 1)
          << names[r.value];
    }
    const std::regex edge("\n  ([a-z0-9_]+) -> ([a-z0-9_]+)");
    for (std::sregex_iterator at(part.begin(), part.end(), edge); at != std::sregex_iterator(); ++at) {
      for (const std::size_t end : {1U, 2U}) {
        EXPECT_EQ(times(part, "  " + (*at)[end].str() + " ["), 1) << (*at)[end].str();
      }
    }
  }
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
  const std::string dot = to_dot(toy_pipeline(), "toy 6/6");
  EXPECT_EQ(times(dot, "label=\"toy 6/6\""), 1);
  EXPECT_EQ(times(dot, "  r3_4_5_5 -> v10 [ label=\"sign\" style=dashed]\n"), 1) << "the difference's sign";
  EXPECT_EQ(times(dot, "  r1_1_5_0 -> v5 [ arrowhead=odot]\n"), 1) << "an inverted operand";
  EXPECT_EQ(times(dot, "  r11_5_0_0 -> out_hit [ arrowhead=odot]\n"), 1) << "an inverted output";
  EXPECT_EQ(times(dot, "xlabel=\"stages 3-4\""), 1) << "the multiplier";
  EXPECT_EQ(times(dot, "tooltip=\"toy_cmp\""), 1);
}

TEST(ToySchematic, EveryOperandIsAnEdge) {
  const Pipeline p = toy_pipeline();
  const std::string dot = to_dot(p, "toy");
  const std::regex edge("\n  r?v?[0-9_]+ -> v([0-9]+) ");
  std::vector<int> edges(p.graph.size(), 0);
  for (std::sregex_iterator at(dot.begin(), dot.end(), edge); at != std::sregex_iterator(); ++at) {
    ++edges[static_cast<std::size_t>(std::stoi((*at)[1]))];
  }
  for (NodeId id = 0; id < p.graph.size(); ++id) {
    EXPECT_EQ(edges[id], is_root(p.graph[id].op) ? p.graph[id].arity() : 0) << "%" << id;
  }
}

TEST(ToySchematic, GraphvizDrawsIt) {
  const File svg = draw({{"toy.dot", to_dot(toy_pipeline(), "toy")}}).front();
  EXPECT_EQ(times(svg.contents, ">L:6</text>"), times(to_dot(toy_pipeline(), "toy"), "label=\"L:6\""));
  EXPECT_EQ(times(svg.contents, ">stage 5</text>"), 1);
}

}  // namespace
}  // namespace hitpipe::rtl
