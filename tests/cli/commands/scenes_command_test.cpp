// `hitpipe scenes`: the same list as text, CSV and JSON; --triangles.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "sw_ref/scene/built_in.hpp"
#include "tests/cli/program.hpp"

namespace hitpipe::cli::scenes_command_test {
namespace {

TEST(ScenesCommand, PrintsATable) {
  const Outcome outcome = run_hitpipe({"scenes"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
  const auto lines = lines_of(outcome.out);
  ASSERT_EQ(lines.size(), ref::built_in_scenes().size() + 1);
  EXPECT_TRUE(lines[0].starts_with("scene "));
  EXPECT_TRUE(lines[1].starts_with("spheres "));
  EXPECT_LE(widest_line(outcome.out), 80U);
}

TEST(ScenesCommand, PrintsCsvAndJson) {
  const auto lines = lines_of(run_hitpipe({"scenes", "--format", "csv"}).out);
  ASSERT_EQ(lines.size(), ref::built_in_scenes().size() + 1);
  EXPECT_EQ(lines[0], "scene,triangles,least,most,lights,stands_for,what");
  EXPECT_EQ(lines[2], "branch,312706,80000,10000000,2,Branch,a spruce branch with cones");
  const auto list = nlohmann::json::parse(run_hitpipe({"scenes", "--format", "json"}).out);
  ASSERT_EQ(list.size(), ref::built_in_scenes().size());
  EXPECT_EQ(list[0].at("scene"), "spheres");
  EXPECT_EQ(list[0].at("triangles"), 24'578);
}

TEST(SceneOptions, TrianglesThatASceneCannotHaveRejected) {
  const auto rejected = [](const std::vector<std::string>& scene, const std::string& message) {
    std::vector<std::string> arguments{"render", "--width", "4", "--height", "4", "--scene"};
    arguments.insert(arguments.end(), scene.begin(), scene.end());
    const Outcome outcome = run_hitpipe(arguments);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(outcome.err, "hitpipe: " + message + "\n");
  };
  rejected({"statue", "--triangles", "9999"},
           "scene \"statue\": 9999 triangles; allowed are 10000 to 50000000");
  rejected({"spheres", "--triangles", "100"},
           "scene \"spheres\": has 24578 triangles; their number can be chosen for: " + ref::scaling_names());
  rejected({"statue", "--triangles", "-5"},
           "--triangles: Value -5 not in range 1 to 100000000; see hitpipe render --help");
}

}  // namespace
}  // namespace hitpipe::cli::scenes_command_test
