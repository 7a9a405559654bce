// `hitpipe bvh`: the figures of a scene's hierarchy, and the sweep of Appendix B.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/program.hpp"

namespace hitpipe::cli::bvh_command_test {
namespace {

using Json = nlohmann::json;
using testing::HasSubstr;
using testing::StartsWith;

std::string printed(std::vector<std::string> more) {
  const Outcome outcome = run_hitpipe(with({"bvh", "--scene", "spheres"}, more));
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
  return outcome.out;
}

Json figures(std::vector<std::string> more) {
  more.insert(more.end(), {"--format", "json"});
  return Json::parse(printed(std::move(more)));
}

TEST(BvhCommand, PrintsFiguresThatAgreeWithEachOther) {
  const Json made = figures({"--threads", "1"});
  EXPECT_EQ(made.at("triangles"), 24'578);
  EXPECT_EQ(made.at("builder"), "median");
  EXPECT_EQ(made.at("max_triangles"), 6);
  const auto nodes = made.at("bvh_nodes").get<int>();
  const auto leaves = made.at("leaves").get<int>();
  EXPECT_EQ(nodes, 2 * leaves - 1);
  EXPECT_EQ(made.at("node_bytes"), 32 * nodes);
  EXPECT_EQ(made.at("order_bytes"), 4 * 24'578);
  EXPECT_NEAR(made.at("triangles_per_leaf"), 24'578.0 / leaves, 1e-9);
  EXPECT_EQ(made.at("triangles_in_largest_leaf"), 6);
  int in_list = 0;
  int triangles = 0;
  for (const Json& entry : made.at("leaves_by_triangles")) {
    const auto text = entry.get<std::string>();
    const int count = std::stoi(text.substr(text.find(':') + 1));
    in_list += count;
    triangles += count * std::stoi(text);
  }
  EXPECT_EQ(in_list, leaves);
  EXPECT_EQ(triangles, 24'578);
}

TEST(BvhCommand, TakesTheOptionsOfABuild) {
  const Json made = figures({"--max-triangles", "100", "--max-depth", "9"});
  EXPECT_EQ(made.at("depth"), 9);
  EXPECT_THAT(made.at("leaves_by_triangles").dump(), HasSubstr("\"65-128:"));
  EXPECT_LT(figures({"--builder", "sah"}).at("sah_cost"), made.at("sah_cost"));
  EXPECT_GT(figures({"--padding", "0.0009"}).at("sah_cost"), figures({}).at("sah_cost"));
  EXPECT_LT(figures({"--grid-bits", "8"}).at("bvh_nodes"), figures({}).at("bvh_nodes"));
}

TEST(BvhCommand, PrintsTextThatFitsEightyColumnsAndCsv) {
  const std::string text = printed({"--builder", "sah"});
  EXPECT_LE(widest_line(text), 80U);
  EXPECT_THAT(text, HasSubstr("\nbuilder                    sah\n"));
  const auto lines = lines_of(printed({"--format", "csv"}));
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0],
            "scene,triangles,degenerate_dropped,lost_to_rounding,mesh_share_of_cube_pct,area,min,max,builder,"
            "max_triangles,bvh_nodes,leaves,depth,"
            "triangles_per_leaf,triangles_in_largest_leaf,leaves_by_triangles,sah_cost,child_overlap_pct,"
            "node_bytes,order_bytes,build_seconds");
}

TEST(BvhCommand, SweepsTheLeafSizesOfAppendixB) {
  const std::string text = printed({"--sweep"});
  EXPECT_LE(widest_line(text), 80U);
  EXPECT_THAT(text, StartsWith("spheres: 24578 triangles (0 without area, 0 lost), 97.8 % of the cube, "
                               "median\nmax_triangles  bvh_nodes"));
  const Json rows = figures({"--sweep"});
  ASSERT_EQ(rows.size(), 23U);
  EXPECT_EQ(rows[0].at("max_triangles"), 1);
  EXPECT_EQ(rows[0].at("bvh_nodes"), 2 * 24'578 - 1);
  EXPECT_EQ(rows[22].at("max_triangles"), 512);
  EXPECT_EQ(rows[5].at("bvh_nodes"), figures({}).at("bvh_nodes"));
}

}  // namespace
}  // namespace hitpipe::cli::bvh_command_test
