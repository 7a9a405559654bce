// `hitpipe render`: an image in software, with counts.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/program.hpp"

namespace hitpipe::cli {
namespace {

using testing::StartsWith;

const std::vector<std::string> small{"render", "--scene", "spheres", "--width", "40", "--height", "30"};

std::vector<std::string> with(std::vector<std::string> arguments, const std::vector<std::string>& more) {
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

TEST(RenderCommand, PrintsCountsAndWritesTheImage) {
  const sim::TemporaryFolder folder;
  for (const char* const name : {"image.png", "image.exr"}) {
    const std::string image = (folder.path() / name).string();
    const Outcome outcome = run_hitpipe(with(small, {"--out", image, "--format", "json"}));
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.err, "");
    const auto object = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(object.at("scene"), "spheres");
    EXPECT_EQ(object.at("triangles"), 24578);
    EXPECT_EQ(object.at("degenerate_dropped"), 0);
    EXPECT_EQ(object.at("rays_primary"), 1200);
    EXPECT_GT(object.at("rays_shadow"), 100);
    EXPECT_GT(object.at("box_tests"), 1200);
    EXPECT_GT(object.at("triangle_tests"), 0);
    EXPECT_EQ(object.at("image"), image);
    const double rays = object.at("rays_primary").get<double>() + object.at("rays_shadow").get<double>();
    EXPECT_DOUBLE_EQ(object.at("box_tests_per_ray"), object.at("box_tests").get<double>() / rays);
    EXPECT_DOUBLE_EQ(object.at("triangle_tests_per_ray"), object.at("triangle_tests").get<double>() / rays);
  }
  EXPECT_THAT(contents_of(folder.path() / "image.png"), StartsWith("\x89PNG"));
  EXPECT_THAT(contents_of(folder.path() / "image.exr"), StartsWith("v/1\x01"));
  EXPECT_EQ(files_below(folder.path()).size(), 2U);
}

TEST(RenderCommand, PrintsTextThatFitsEightyColumnsAndCsv) {
  const Outcome text = run_hitpipe(small);
  EXPECT_EQ(text.exit_code, 0);
  EXPECT_LE(widest_line(text.out), 80U);
  EXPECT_THAT(text.out, StartsWith("scene                   spheres\ntriangles               24,578\n"));
  const auto lines = lines_of(run_hitpipe(with(small, {"--format", "csv"})).out);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(
      lines[0],
      "scene,triangles,degenerate_dropped,bvh_nodes,rays_primary,rays_shadow,box_tests,box_tests_per_ray,"
      "triangle_tests,triangle_tests_per_ray,seconds");
  EXPECT_THAT(lines[1], StartsWith("spheres,24578,0,"));
}

TEST(RenderCommand, BoxTestsDifferInWork) {
  const auto box_tests = [](const std::string& kind) {
    const Outcome outcome = run_hitpipe(with(small, {"--box-test", kind, "--format", "json"}));
    EXPECT_EQ(outcome.exit_code, 0);
    return nlohmann::json::parse(outcome.out).at("box_tests").get<int>();
  };
  EXPECT_LE(box_tests("float"), box_tests("robust"));
  const Outcome unknown = run_hitpipe(with(small, {"--box-test", "exact"}));
  EXPECT_NE(unknown.exit_code, 0);
  EXPECT_EQ(unknown.err, "hitpipe: --box-test: exact is none of float, robust; see hitpipe render --help\n");
}

/// The options mean what their help says: one light more makes more shadow rays, another eye another picture.
TEST(RenderCommand, PlacesCameraAndLights) {
  const auto shown = [](const std::vector<std::string>& options) {
    const Outcome outcome = run_hitpipe(with(small, with(options, {"--format", "json"})));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return nlohmann::json::parse(outcome.out);
  };
  const auto one = shown({"--light", "0,50,0"});
  const auto two = shown({"--light", "0,50,0", "--light=0,50,0"});
  EXPECT_GT(one.at("rays_shadow"), 0);
  EXPECT_EQ(two.at("rays_shadow"), 2 * one.at("rays_shadow").get<int>());
  EXPECT_EQ(two.at("rays_primary"), one.at("rays_primary"));
  const auto above = shown({"--eye", "-1.5e1,40,.5", "--target", "0,0,0", "--up", "0,0,-1", "--fov", "20"});
  EXPECT_NE(above.at("box_tests"), shown({}).at("box_tests"));
}

TEST(RenderCommand, DoesNotDependOnThreads) {
  const sim::TemporaryFolder folder;
  const auto rendered = [&](const std::string& threads) {
    const std::string image = (folder.path() / (threads + ".png")).string();
    const Outcome outcome = run_hitpipe(with(small, {"--threads", threads, "--out", image}));
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.err, "");
    return contents_of(image);
  };
  EXPECT_EQ(rendered("1"), rendered("2"));
  EXPECT_EQ(rendered("1"), rendered("1024"));
}

}  // namespace
}  // namespace hitpipe::cli
