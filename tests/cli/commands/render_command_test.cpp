// `hitpipe render`: an image in software, with counts.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/program.hpp"

namespace hitpipe::cli::render_command_test {
namespace {

using testing::StartsWith;

const std::vector<std::string> small{"render", "--scene", "spheres", "--width", "40", "--height", "30"};

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
    EXPECT_GE(object.at("rays_secondary"), 0);
    EXPECT_GT(object.at("rays_shadow"), 100);
    // A few of the camera's rays are nearly parallel to the plane x = 0.
    EXPECT_GT(object.at("stiff_rays_pct"), 0.0);
    EXPECT_LT(object.at("stiff_rays_pct"), 5.0);
    EXPECT_LE(object.at("zero_component_rays_pct"), object.at("stiff_rays_pct"));
    EXPECT_EQ(object.at("bytes_per_node"), 32);
    EXPECT_EQ(object.at("node_bytes"), 32 * object.at("bvh_nodes").get<int>());
    EXPECT_EQ(object.at("image"), image);
    EXPECT_FALSE(object.contains("depth_map"));
    double rays = 0;
    for (const char* const kind : {"primary", "secondary", "shadow"})
      rays += object.at(std::string("rays_") + kind).get<double>();
    for (const std::string work : {"box_tests", "triangle_tests", "nodes_loaded", "triangles_loaded"}) {
      const auto total = object.at(work).get<double>();
      EXPECT_GT(total, 0.0) << work;
      EXPECT_DOUBLE_EQ(object.at(work + "_per_ray"), total / rays) << work;
      double sum = 0;
      for (const std::string kind : {"primary", "secondary", "shadow"})
        sum += object.at(work + "_per_" + kind).get<double>() * object.at("rays_" + kind).get<double>();
      EXPECT_NEAR(sum, total, 1e-6 * total) << work;
    }
    // Single rays load a node for each test.
    EXPECT_EQ(object.at("nodes_loaded"), object.at("box_tests"));
  }
  EXPECT_THAT(contents_of(folder.path() / "image.png"), StartsWith("\x89PNG"));
  EXPECT_THAT(contents_of(folder.path() / "image.exr"), StartsWith("v/1\x01"));
  EXPECT_EQ(files_below(folder.path()).size(), 2U);
}

TEST(RenderCommand, PrintsTextThatFitsEightyColumnsAndCsv) {
  const Outcome text = run_hitpipe(small);
  EXPECT_EQ(text.exit_code, 0);
  EXPECT_LE(widest_line(text.out), 80U);
  EXPECT_THAT(
      text.out,
      StartsWith(
          "scene                           spheres\nstands_for                      Spheres\ntriangles "));
  const auto lines = lines_of(run_hitpipe(with(small, {"--format", "csv"})).out);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(
      lines[0],
      "scene,stands_for,triangles,degenerate_dropped,lost_to_rounding,mesh_share_of_cube_pct,bvh_nodes,"
      "hierarchy,bytes_per_node,node_bytes,rays_"
      "primary,"
      "rays_secondary,rays_shadow,stiff_rays_pct,zero_component_rays_pct,surface_points,light_evaluations,"
      "queue_bytes_primary,queue_bytes_secondary,queue_bytes_shadow,"
      "box_tests,box_tests_per_ray,box_tests_per_primary,box_tests_per_secondary,box_tests_per_shadow,"
      "triangle_tests,triangle_tests_per_ray,triangle_tests_per_primary,triangle_tests_per_secondary,"
      "triangle_tests_per_shadow,"
      "nodes_loaded,nodes_loaded_per_ray,nodes_loaded_per_primary,nodes_loaded_per_secondary,"
      "nodes_loaded_per_shadow,"
      "triangles_loaded,triangles_loaded_per_ray,triangles_loaded_per_primary,"
      "triangles_loaded_per_secondary,triangles_loaded_per_shadow,seconds");
  EXPECT_THAT(lines[1], StartsWith("spheres,Spheres,24578,0,"));
}

/// Every way of tracing makes the same image with different work.
TEST(RenderCommand, TracesAsItIsTold) {
  const sim::TemporaryFolder folder;
  std::string first;
  std::vector<nlohmann::json> shown;
  for (const std::vector<std::string>& options : std::vector<std::vector<std::string>>{
           {},
           {"--traversal", "slabs-dist", "--arithmetic", "float"},
           {"--traversal", "plu-dsa", "--arithmetic", "double", "--bundle", "64"},
           {"--arithmetic", "integer", "--bits", "16/20"},
           {"--arithmetic", "float", "--encoding", "h8", "--lut"},
           {"--traversal", "slabs-dist", "--encoding", "wide8"},
           {"--encoding", "pair10"}}) {
    const std::string image = (folder.path() / "image.png").string();
    const Outcome outcome = run_hitpipe(with(small, with(options, {"--out", image, "--format", "json"})));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    if (first.empty()) first = contents_of(image);
    EXPECT_EQ(contents_of(image), first) << outcome.out;
    shown.push_back(nlohmann::json::parse(outcome.out));
  }
  std::vector<int> bytes;
  for (const auto& object : shown) bytes.push_back(object.at("bytes_per_node"));
  EXPECT_THAT(bytes, testing::ElementsAre(32, 32, 56, 20, 12, 80, 20));
  EXPECT_LT(shown[2].at("nodes_loaded"), shown[2].at("box_tests"));
}

TEST(RenderCommand, DrawsMapsWhereTold) {
  const sim::TemporaryFolder folder;
  const auto file = [&](const char* name) { return (folder.path() / name).string(); };
  const Outcome outcome = run_hitpipe(with(small, {"--depth-map", file("d.png"), "--box-map", file("b.exr"),
                                                   "--triangle-map", file("t.png"), "--format", "json"}));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(files_below(folder.path()), (std::vector<std::string>{"b.exr", "d.png", "t.png"}));
  const auto object = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(object.at("depth_map"), file("d.png"));
  EXPECT_GT(object.at("depth_map_low"), 0.0);
  EXPECT_GT(object.at("depth_map_high"), object.at("depth_map_low"));
  EXPECT_EQ(object.at("box_map_low"), 0.0);
  EXPECT_GT(object.at("box_map_high"), object.at("box_tests_per_primary"));
  EXPECT_GT(object.at("triangle_map_high"), 1.0);
}

/// The options do what their help says: another light makes more shadow rays, another eye or projection makes
/// another picture. Threads change nothing.
TEST(RenderCommand, PlacesCameraAndLights) {
  const auto shown = [](const std::string& options) {
    auto row = nlohmann::json::parse(
        printed("render --scene spheres --width 40 --height 30 --format json " + options));
    row.erase("seconds");
    return row;
  };
  const auto own = shown("");
  EXPECT_EQ(shown("--threads 64"), own);
  EXPECT_EQ(shown("--perspective"), own);
  const auto one = shown("--light 0,50,0");
  const auto two = shown("--light 0,50,0 --light=0,50,0");
  EXPECT_GT(one.at("rays_shadow"), 0);
  EXPECT_EQ(two.at("rays_shadow"), 2 * one.at("rays_shadow").get<int>());
  EXPECT_EQ(two.at("rays_primary"), one.at("rays_primary"));
  EXPECT_NE(shown("--eye -1.5e1,40,.5 --target 0,0,0 --up 0,0,-1 --fov 20").at("box_tests"),
            own.at("box_tests"));
  const auto parallel = shown("--orthographic");
  EXPECT_NE(parallel.at("box_tests"), own.at("box_tests"));
  const auto sun = shown("--orthographic --sun 0,1,0");
  EXPECT_EQ(sun.at("rays_primary"), parallel.at("rays_primary"));
  EXPECT_GT(sun.at("rays_shadow"), 0);
  EXPECT_LT(sun.at("rays_shadow"), parallel.at("rays_shadow"));  // of two lights
  EXPECT_GT(shown("--orthographic --sun 0,1,0 --light 0,50,0").at("rays_shadow"), sun.at("rays_shadow"));
  EXPECT_LT(shown("--bounces 0").at("rays_secondary"), own.at("rays_secondary"));
}

/// The tracer refuses these; the message is one line.
TEST(RenderCommand, CombinationsThatDoNotExistRejected) {
  for (const std::string options : {"--traversal plu", "--lut", "--arithmetic integer --bundle 64",
                                    "--arithmetic integer --bits 99/99"}) {
    const Outcome outcome = hitpipe("render --scene spheres --width 8 --height 8 " + options);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err, testing::MatchesRegex("hitpipe: [^\n]+\n"));
  }
}

TEST(RenderCompare, SaysHowFarImagesAreApart) {
  const sim::TemporaryFolder folder;
  const auto rendered = [&](const char* name, const std::string& light) {
    const std::string file = (folder.path() / name).string();
    printed("render --scene spheres --width 24 --height 16 --light " + light + " --out " + file);
    return file;
  };
  const std::string a = rendered("a.png", "0,50,0");
  const std::string b = rendered("b.png", "50,0,0");
  const auto same = nlohmann::json::parse(printed("render --compare " + a + " " + a + " --format json"));
  EXPECT_EQ(same.at("width"), 24);
  EXPECT_EQ(same.at("height"), 16);
  EXPECT_EQ(same.at("pixels"), 384);
  EXPECT_EQ(same.at("different_pixels"), 0);
  EXPECT_TRUE(same.at("psnr_db").is_null());  // infinite
  EXPECT_THAT(printed("render --compare " + a + " " + a), testing::HasSubstr("\npsnr_db             inf\n"));

  const std::string map = (folder.path() / "d.png").string();
  const Outcome outcome = hitpipe("render " + a + " --compare --out " + map + " --format json " + b);
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(outcome.err, "");
  const auto apart = nlohmann::json::parse(outcome.out);
  EXPECT_GT(apart.at("different_pixels"), 20);
  EXPECT_GT(apart.at("largest_difference"), 0.1);
  EXPECT_GT(apart.at("mean_difference"), 0.0);
  EXPECT_GT(apart.at("psnr_db"), 5.0);
  EXPECT_EQ(apart.at("difference_image"), map);
  EXPECT_THAT(contents_of(map), StartsWith("\x89PNG"));
  printed("render --compare " + a + " " + b + " --tolerance 1");
}

/// A cube, whose faces are cut along the diagonal of a square picture from above: rays through that edge, and
/// the same through its corners.
constexpr const char* cube =
    "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n"
    "f 1 3 2\nf 1 4 3\nf 5 6 7\nf 5 7 8\nf 1 2 6\nf 1 6 5\nf 4 8 7\nf 4 7 3\nf 1 5 8\nf 1 8 4\nf 2 3 7\nf 2 "
    "7 6\n";

TEST(RenderCrossings, OfAClosedMeshAreEvenAtItsEdgesToo) {
  const sim::TemporaryFolder folder;
  const std::string mesh = folder.write("cube.obj", cube).string();
  const std::string image = (folder.path() / "counts.png").string();
  const std::string words =
      "render --scene " + mesh +
      " --crossings --orthographic --eye 0,0,1.8 --target 0,0,0 --up 0,1,0 --cube 0,0,0,2 "
      "--width 32 --height 32 --format json ";
  const auto seen = nlohmann::json::parse(printed(words + "--out " + image));
  EXPECT_EQ(seen.at("scene"), "cube");
  EXPECT_EQ(seen.at("triangles"), 12);
  EXPECT_EQ(seen.at("rays"), 1024);
  EXPECT_GT(seen.at("crossings"), 1000);
  EXPECT_EQ(seen.at("most_crossings"), 2);
  EXPECT_EQ(seen.at("odd_rays"), 0);
  EXPECT_GT(seen.at("ties_settled"), 100);
  EXPECT_EQ(seen.at("image"), image);
  EXPECT_THAT(contents_of(image), StartsWith("\x89PNG"));
  // No other hierarchy and no other boxes change a count, and the world is the same when it is named.
  for (const std::string options : {"--world integer --bits 20+1s20", "--boxes 20+1/9s20",
                                    "--builder sah --max-triangles 1 --threads 3"}) {
    auto same = nlohmann::json::parse(printed(words + options));
    for (const char* const count : {"crossings", "odd_rays", "ties_settled"})
      EXPECT_EQ(same.at(count), seen.at(count)) << options;
  }
  // From inside each ray leaves the cube once.
  const auto inside = nlohmann::json::parse(
      printed("render --scene " + mesh +
              " --crossings --eye 0,0,0 --target 1,1,1 --width 9 --height 9 --format json"));
  EXPECT_EQ(inside.at("odd_rays"), 81);
  EXPECT_EQ(inside.at("closed"), true);
}

TEST(RenderCrossings, OfLinesAtEdgesAreEvenIfTheMeshIsClosed) {
  const sim::TemporaryFolder folder;
  const std::string mesh = folder.write("cube.obj", cube).string();
  const std::string words = "render --crossings --edge-rays 20001 --format json --scene " + mesh;
  const auto seen = nlohmann::json::parse(printed(words));
  EXPECT_EQ(seen.at("closed"), true);
  EXPECT_EQ(seen.at("rays"), 20'002);
  EXPECT_EQ(seen.at("odd_lines"), 0);
  EXPECT_EQ(seen.at("unbalanced_lines"), 0);
  EXPECT_GT(seen.at("tied_rays"), 5000);
  EXPECT_GT(seen.at("lines_from_inside"), 100);
  EXPECT_NE(nlohmann::json::parse(printed(words + " --seed 2")).at("crossings"), seen.at("crossings"));
  // An odd count of an open mesh is no fault.
  const auto open =
      nlohmann::json::parse(printed("render --crossings --edge-rays 2000 --scene spheres --format json"));
  EXPECT_EQ(open.at("closed"), false);
  EXPECT_EQ(open.at("open_edges"), 4);
  EXPECT_GT(open.at("odd_lines"), 100);
}

TEST(RenderCrossings, OptionsOfEdgeRaysAloneRejected) {
  const auto err = [](const std::string& words) { return hitpipe("render --scene spheres " + words).err; };
  EXPECT_THAT(err("--edge-rays 5"), testing::HasSubstr("--edge-rays requires --crossings"));
  EXPECT_THAT(err("--crossings --seed 5"), testing::HasSubstr("--seed: needs --edge-rays"));
  EXPECT_THAT(err("--crossings --edge-rays 5 --out a.png"),
              testing::HasSubstr("--edge-rays excludes --out: rays at edges make no picture"));
  EXPECT_THAT(err("--crossings --edge-rays 1"),
              testing::HasSubstr("Value 1 not in range 2 to 1000000000000"));
}

TEST(RenderRescale, CountsThePixelsThatChange) {
  const std::string words = "render --rescale --scene spheres --width 40 --height 30 ";
  const std::string text = printed(words);
  EXPECT_LE(widest_line(text), 80U);
  const auto lines = lines_of(text);
  ASSERT_EQ(lines.size(), 10U);
  EXPECT_EQ(lines[0], "spheres: 12316 vertices, 1200 pixels");
  EXPECT_THAT(lines[1], StartsWith("transform "));
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_THAT(lines[2 + i],
                StartsWith(std::vector<std::string>{"2^-100 ", "2^-10 ", "2^10 ", "2^100 "}[i]));
    EXPECT_THAT(lines[2 + i], testing::ContainsRegex(" 0 +0 +0 +0$"));
  }
  EXPECT_EQ(lines_of(printed(words + "--scale 2 --format csv")),
            (std::vector<std::string>{"transform,vertices_moved,lost_to_rounding,pixels_other_triangle,"
                                      "pixels_other_colour,different_triangles,rtl_mismatches",
                                      "2,0,0,0,0,,"}));
  const Outcome too_large = hitpipe(words + "--scale 2^127");
  EXPECT_EQ(too_large.exit_code, 2);
  EXPECT_THAT(too_large.err, testing::MatchesRegex(
                                 "hitpipe: transform 2\\^127: vertex [^\n]* leaves the range of binary32\n"));
}

}  // namespace
}  // namespace hitpipe::cli::render_command_test
