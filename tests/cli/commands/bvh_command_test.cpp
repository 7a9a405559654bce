// `hitpipe bvh`: the figures of a scene's hierarchy, and the sweep of Appendix B.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/program.hpp"
#include "tests/sim/temporary_folder.hpp"

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
            "scene,triangles,degenerate_dropped,lost_to_rounding,mesh_share_of_cube_pct,area,min,max,"
            "closed,oriented,edges,odd_edges,open_edges,turned_edges,crowded_edges,t_junctions,"
            "first_odd_edges,first_t_junctions,builder,"
            "max_triangles,bvh_nodes,leaves,depth,"
            "triangles_per_leaf,triangles_in_largest_leaf,leaves_by_triangles,sah_cost,child_overlap_pct,"
            "node_bytes,order_bytes,build_seconds");
}

TEST(BvhCommand, SaysWhereAMeshIsOpen) {
  const std::string text = printed({});
  EXPECT_THAT(text, HasSubstr("\nclosed                     no\n"));
  EXPECT_THAT(text, HasSubstr("\nodd_edges                  4\n"));
  EXPECT_THAT(text, HasSubstr("\nfirst_odd_edges            of 0 from -9 "));
  const Json floor = figures({});
  EXPECT_EQ(floor.at("closed"), false);
  EXPECT_EQ(floor.at("open_edges"), 4);
  ASSERT_EQ(floor.at("first_odd_edges").size(), 3U);
  EXPECT_EQ(floor.at("first_odd_edges")[2].at("triangle"), 1);
  EXPECT_NEAR(floor.at("first_odd_edges")[2].at("to")[0].get<double>(), 9.0, 1e-6);

  const sim::TemporaryFolder folder;
  const auto of_file = [&](const std::string& faces) {
    const std::string file = folder
                                 .write("t.obj",
                                        "v 0 0 0\nv 4 4 0\nv 0 4 0\nv 0 0 4\nv 0 1 0\n"
                                        "f 1 3 2\nf 2 3 4\nf 1 2 4\n" +
                                            faces)
                                 .string();
    return Json::parse(cli::printed("bvh --format json --scene " + file));
  };
  const Json closed = of_file("f 3 1 4\n");
  EXPECT_EQ(closed.at("closed"), true);
  EXPECT_EQ(closed.at("oriented"), true);
  EXPECT_EQ(closed.at("edges"), 6);
  EXPECT_TRUE(closed.at("first_odd_edges").empty());
  const Json cut = of_file("f 3 5 4\nf 5 1 4\n");
  EXPECT_EQ(cut.at("closed"), false);
  EXPECT_EQ(cut.at("open_edges"), 0);
  EXPECT_EQ(cut.at("t_junctions"), 1);
  ASSERT_EQ(cut.at("first_t_junctions").size(), 1U);
  EXPECT_EQ(cut.at("first_t_junctions")[0].at("triangle"), 0);
  // The third corner of a triangle without area lies on its longest edge.
  const Json sewn = of_file("f 3 5 4\nf 5 1 4\nf 3 1 5\n");
  EXPECT_EQ(sewn.at("degenerate_dropped"), 1);
  EXPECT_EQ(sewn.at("oriented"), true);
}

TEST(BvhCommand, SaysWhatInstancesSave) {
  const std::string file = HITPIPE_SOURCE "/tests/cli/meshes/gltf_required_extension/instances.gltf";
  const Json made = Json::parse(cli::printed("bvh --format json --scene " + file));
  EXPECT_EQ(made.at("meshes"), 1);
  EXPECT_EQ(made.at("instances"), 2);
  EXPECT_EQ(made.at("triangles_stored"), 2);
  EXPECT_EQ(made.at("triangles_flattened"), 4);
  EXPECT_EQ(made.at("bytes_stored"), 4 * 24 + 2 * 12 + 2 * 112);
  EXPECT_EQ(made.at("bytes_flattened"), 8 * 24 + 4 * 12);
  EXPECT_THAT(cli::printed("bvh --scene " + file), HasSubstr("\ntriangles_flattened        4\n"));
  const std::string plain = HITPIPE_SOURCE "/tests/cli/meshes/gltf_percent_uri/p.gltf";
  EXPECT_FALSE(Json::parse(cli::printed("bvh --format json --scene " + plain)).contains("instances"));
}

TEST(BvhCommand, PrintsCornersOfTheFile) {
  const sim::TemporaryFolder folder;
  const std::string obj = folder.write("t.obj", "v 0 0 0\nv 4 0 0\nv 0.1 3.7 -1e-9\nf 1 2 3\n").string();
  const std::string text = cli::printed("bvh --scene " + obj);
  EXPECT_THAT(text, HasSubstr("\nmin                        0 0 -1e-09\n"));
  EXPECT_THAT(text, HasSubstr("\nmax                        4 3.7 0\n"));
  const Json made = Json::parse(cli::printed("bvh --format json --scene " + obj));
  EXPECT_EQ(made.at("min"), (Json{0.0, 0.0, -1e-9}));
  EXPECT_EQ(made.at("max"), (Json{4.0, 3.7, 0.0}));
  ASSERT_EQ(made.at("first_odd_edges").size(), 3U);
  for (const Json& edge : made.at("first_odd_edges")) {
    for (const char* const end : {"from", "to"})
      EXPECT_THAT((std::vector<Json>{{0.0, 0.0, 0.0}, {4.0, 0.0, 0.0}, {0.1, 3.7, -1e-9}}),
                  testing::Contains(edge.at(end)));
  }
  const std::string ply = folder
                              .write("t.ply",
                                     "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty "
                                     "float y\nproperty float z\n"
                                     "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                                     "0.1 0 0\n4 0 0\n0.1 0.3 0\n3 0 1 2\n")
                              .string();
  EXPECT_THAT(cli::printed("bvh --scene " + ply), HasSubstr("\nmin                        0.1 0 0\n"));
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
