// `hitpipe core trace`: a core answers every ray of a picture, and the figures say how busy it was.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "sw_ref/render/image_file.hpp"
#include "tests/cli/program.hpp"

namespace hitpipe::cli::trace_command_test {
namespace {

using testing::HasSubstr;

std::vector<std::string> words(std::vector<std::string> more) {
  std::vector<std::string> all{"core", "trace", "--scene", "spheres", "--width", "24", "--height", "24"};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

nlohmann::json rows_of(const std::vector<std::string>& more) {
  std::vector<std::string> all = words(more);
  all.insert(all.end(), {"--native", "--format", "json"});
  const Outcome outcome = run_hitpipe(all);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  return nlohmann::json::parse(outcome.out);
}

TEST(TraceCommand, MoreRaysInFlightKeepThePortBusy) {
  const nlohmann::json rows = rows_of({"--rays-in-flight", "1,16,128"});
  ASSERT_EQ(rows.size(), 3U);
  double busy = 0;
  for (const nlohmann::json& row : rows) {
    EXPECT_EQ(row.at("wrong"), 0);
    EXPECT_EQ(row.at("reads_a_ray"), rows.at(0).at("reads_a_ray"));
    EXPECT_GT(row.at("port_busy_pct"), 1.5 * busy);
    busy = row.at("port_busy_pct");
    EXPECT_NEAR(row.at("cycles_a_ray").get<double>() * busy / 100, row.at("reads_a_ray").get<double>(), 1e-6);
  }
}

TEST(TraceCommand, SaysWhyCyclesWereLost) {
  const std::vector<std::string> shares{"port_busy_pct", "refused_pct", "idle_memory_pct", "idle_inside_pct",
                                        "idle_few_rays_pct"};
  // Each memory, and the cause that takes most of its cycles.
  const std::vector<std::pair<std::vector<std::string>, std::string>> causes{
      {{"--rays-in-flight", "2"}, "idle_memory_pct"},
      {{"--rays-in-flight", "2", "--memory", "ideal,latency=1", "--triangle-ii", "64"}, "idle_inside_pct"},
      {{"--rays-in-flight", "64", "--memory", "ideal,refused_percent=80"}, "refused_pct"},
      {{"--rays-in-flight", "64", "--memory", "ideal,latency=4"}, "port_busy_pct"}};
  for (const auto& [more, cause] : causes) {
    const nlohmann::json row = rows_of(more).at(0);
    double sum = 0;
    for (const std::string& share : shares) {
      sum += row.at(share).get<double>();
      EXPECT_LE(row.at(share), row.at(cause)) << share << ", where most should be " << cause;
    }
    EXPECT_NEAR(sum, 100, 1e-6) << cause;
  }
}

TEST(TraceCommand, MemoriesOfEveryKindGiveTheSameAnswers) {
  const nlohmann::json plain = rows_of({});
  for (const auto& more : {std::vector<std::string>{"--memory", "ideal,latency=1..200"},
                           {"--memory", "dram", "--in-order"},
                           {"--data-bits", "64"},
                           {"--door", "float", "--data-bits", "512"},
                           {"--memory", "axi-256,refused_percent=50"},
                           {"--bits", "20+1s20", "--triangle-ii", "8"}}) {
    const nlohmann::json rows = rows_of(more);
    EXPECT_EQ(rows.at(0).at("wrong"), 0);
    EXPECT_EQ(rows.at(0).at("reads_a_ray"), plain.at(0).at("reads_a_ray"));
  }
  const nlohmann::json cached = rows_of({"--cache", "64"});
  EXPECT_GT(cached.at(0).at("cache_hits_pct"), 50);
  const nlohmann::json model = rows_of({"--cache", "128"});
  EXPECT_LE(model.at(0).at("bytes_a_ray"), cached.at(0).at("bytes_a_ray"));
  EXPECT_LT(cached.at(0).at("bytes_a_ray"), 32 * plain.at(0).at("reads_a_ray").get<double>());
  EXPECT_GT(rows_of({"--memory", "ideal,refused_percent=50"}).at(0).at("refused_pct"), 40);
}

TEST(TraceCommand, VerilogPrintsWhatSoftwarePrints) {
  const std::vector<std::string> more{"--rays-in-flight", "12", "--memory",
                                      "ideal,latency=1..40,refused_percent=10"};
  std::vector<std::string> native = words(more);
  native.push_back("--native");
  const Outcome verilog = run_hitpipe(words(more));
  EXPECT_EQ(verilog.exit_code, 0) << verilog.err;
  EXPECT_EQ(verilog.out, run_hitpipe(native).out);
}

TEST(TraceCommand, WritesThePictureOfItsAnswers) {
  const sim::TemporaryFolder folder;
  const std::string out = (folder.path() / "core").string();
  rows_of({"--out", out});
  const ref::StoredImage picture = ref::read_image(folder.path() / "core" / "spheres.png");
  const std::string rendered = (folder.path() / "rendered.png").string();
  EXPECT_EQ(run_hitpipe({"render", "--scene", "spheres", "--width", "24", "--height", "24", "--world",
                         "integer", "--builder", "sah", "--max-triangles", "2", "--out", rendered})
                .exit_code,
            0);
  EXPECT_EQ(picture.values, ref::read_image(rendered).values);
}

TEST(TraceCommand, TracesTheRaysOfAFile) {
  const sim::TemporaryFolder folder;
  const std::string rays =
      folder.write("rays.csv", "ox,oy,oz,dx,dy,dz,any\n0,9,0,0,-1,0,0\n0,9,0,0.1,-1,0,1\n0,9,0,0,1,0,0\n")
          .string();
  const std::vector<std::string> words{"core",   "trace", "--scene",  "spheres",
                                       "--rays", rays,    "--format", "json"};
  for (const std::vector<std::string>& more : {std::vector<std::string>{}, {"--native"}}) {
    const Outcome outcome = run_hitpipe(with(words, more));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const nlohmann::json row = nlohmann::json::parse(outcome.out).at(0);
    EXPECT_EQ(row.at("rays"), 3);
    EXPECT_EQ(row.at("wrong"), 0);
    EXPECT_GT(row.at("reads_a_ray"), 1.0);
  }
  const Outcome picture = run_hitpipe(with(words, {"--out", (folder.path() / "out").string()}));
  EXPECT_EQ(picture.exit_code, 2);
  EXPECT_THAT(picture.err, HasSubstr("--rays excludes --out: the rays of a file make no picture"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out"));
}

/// A mesh and its image.
class TraceOfAnImage : public testing::Test {
 protected:
  void SetUp() override {
    // Four walls, and among them a triangle without area.
    folder_.write("walls.obj",
                  "v 0 0 0\nv 2 0 0\nv 0 2 0\nv 0 0 2\nv 1 1 1\n"
                  "f 1 2 3\nf 2 2 3\nf 1 3 4\nf 1 4 2\nf 5 2 3\n");
    folder_.write("rays.csv",
                  "ox,oy,oz,dx,dy,dz,any\n1.5,1,2,-1,-0.5,-2,0\n0.5,0.5,2,0,0,-1,1\n1,1,2,0,0,1,0\n"
                  "1.5,1,2,-1,-1.2,-1.7,0\n");
    printed("core image --scene " + file("walls.obj") + placing_ + " --out " + image_);
  }
  [[nodiscard]] std::string file(const std::string& name) const { return (folder_.path() / name).string(); }
  /// What the core says of the mesh, or of its image.
  std::string traced(const std::string& what, const std::string& more) const {
    return printed("core trace --native --rays-in-flight 4 " + what + more);
  }
  [[nodiscard]] Outcome refused(const std::string& words) const {
    Outcome outcome = hitpipe("core trace --native " + words);
    EXPECT_EQ(outcome.exit_code, 2) << words;
    EXPECT_EQ(outcome.out, "") << words;
    return outcome;
  }

  const std::string placing_ = " --eye 1.5,1,3 --target 0.5,0.5,0 --light 1,2,3";
  const sim::TemporaryFolder folder_;
  const std::string image_ = file("walls.bin");
  const std::string scene_words_ = "--scene " + file("walls.obj") + placing_;
  const std::string image_words_ = "--image " + image_;
};

TEST_F(TraceOfAnImage, MakesThePictureOfTheScene) {
  const std::string more = " --width 16 --height 16 --format json --out ";
  auto of_scene = nlohmann::json::parse(traced(scene_words_, more + file("scene"))).at(0);
  auto of_image = nlohmann::json::parse(traced(image_words_ + placing_, more + file("image"))).at(0);
  EXPECT_EQ(contents_of(file("scene/walls.png")), contents_of(file("image/walls.png")));
  EXPECT_EQ(of_image.at("triangles"), 4);
  EXPECT_EQ(of_image.at("missing_triangles"), 1);
  EXPECT_GT(of_image.at("rays"), 256) << "some see a light";
  for (const auto& [key, value] : of_scene.items()) {
    if (of_image.contains(key) && key != "mesh_share_of_cube_pct") {
      EXPECT_EQ(of_image.at(key), value) << key;
    }
  }
}

TEST_F(TraceOfAnImage, AnswersTheRaysOfAFile) {
  const std::string more = " --rays " + file("rays.csv") + " --answers ";
  traced(scene_words_, more + file("scene.csv"));
  const std::string said = traced(image_words_, more + file("image.csv"));
  EXPECT_EQ(contents_of(file("scene.csv")), contents_of(file("image.csv")));
  EXPECT_THAT(contents_of(file("image.csv")), HasSubstr("nearest,1,3,3,"));
  EXPECT_THAT(said, HasSubstr("hierarchy: that of the image\nscene: 4 triangles (1 missing), "));
  const auto notes = nlohmann::json::parse(contents_of(file("image.csv-metadata.json"))).at("notes").at(0);
  EXPECT_THAT(notes.at("command"), HasSubstr("--image " + image_));
  EXPECT_EQ(notes.at("mesh").at("missing_triangles"), 1);
}

TEST_F(TraceOfAnImage, HasACameraAndTheGridOfTheImage) {
  printed("core image --scene " + file("walls.obj") + " --bits 16+0s12 --out " + image_);
  const auto row = nlohmann::json::parse(traced(image_words_, " --width 16 --height 16 --format json")).at(0);
  EXPECT_EQ(row.at("wrong"), 0);
  EXPECT_GT(row.at("rays"), 256);
  traced(image_words_, " --width 16 --height 16 --bits 16+2s20");
  EXPECT_EQ(refused(image_words_ + " --bits 20+1s20").err,
            "hitpipe: --bits 20+1s20: the image has a grid of 16 bits; allowed are formats that begin with "
            "16+\n");
}

TEST_F(TraceOfAnImage, RefusesRaysThatBeginOutsideItsCube) {
  EXPECT_THAT(
      refused(image_words_ + " --eye 1,1,9").err,
      testing::MatchesRegex("hitpipe: cube of [^\n]*: ray 0 of the picture begins at the eye \\(1, 1, "
                            "9\\); rays must begin in the cube\n"));
  EXPECT_EQ(refused(image_words_ + placing_ + " --orthographic --fov 170").err,
            "hitpipe: --image: ray 0 of the picture begins outside; the orthographic image must begin in the "
            "cube\n");
  folder_.write("far.csv", "ox,oy,oz,dx,dy,dz\n0,0,9,0,0,-1\n");
  EXPECT_EQ(refused(image_words_ + " --rays " + file("far.csv")).err,
            "hitpipe: " + file("far.csv") +
                ": line 2: oz 9 lies outside the cube; a chosen cube must hold all origins\n");
}

TEST_F(TraceOfAnImage, RefusesWhatIsNone) {
  std::string bytes = contents_of(image_);
  bytes.at(170) ^= 1;
  folder_.write("walls.bin", bytes);
  EXPECT_EQ(refused(image_words_).err,
            "hitpipe: " + image_ + ": the checksum differs: the image was changed or half written\n");
  EXPECT_EQ(
      refused("--image " + file("walls.obj")).err.find("hitpipe: " + file("walls.obj") + ": there are "), 0U);
  EXPECT_EQ(refused("--image " + file("none.bin")).err,
            "hitpipe: " + file("none.bin") + ": cannot read the file\n");
  printed("core image --scene spheres --out " + image_);
  EXPECT_THAT(refused(image_words_ + " --levels 3").err, HasSubstr("--levels 3: the scene has "));
}

TEST_F(TraceOfAnImage, RefusesWhatNeedsMoreBits) {
  printed("core image --scene spheres --max-triangles 6 --builder median --out " + image_);
  EXPECT_THAT(refused(image_words_ + " --number-bits 5").err,
              testing::MatchesRegex("hitpipe: --number-bits 5: the scene has [0-9]+ triangles; allowed is "
                                    "[0-9]+ to 32\n"));
  EXPECT_EQ(refused(image_words_ + " --leaf-bits 2").err,
            "hitpipe: --leaf-bits 2: the scene has leaves with 6 triangles; allowed is 3 to 8\n");
}

TEST_F(TraceOfAnImage, IsTheSameByACoreWithFewBits) {
  EXPECT_EQ(traced(image_words_, " --width 8 --height 8 --number-bits 4 --leaf-bits 2 --step-bits 4"),
            traced(image_words_, " --width 8 --height 8"));
}

TEST_F(TraceOfAnImage, IsCutIntoPieces) {
  const std::string work =
      "core trace --native --rays-in-flight 2,4 " + image_words_ + " --width 8 --height 8";
  for (const std::string piece : {"1", "2"})
    printed(work + " --piece " + piece + "/2 --out " + file(piece + ".json"));
  const std::string join = "core trace --join " + file("1.json") + " " + file("2.json");
  EXPECT_EQ(printed(join), printed(work));
  // The second piece is made again, of another image.
  printed("core image --scene " + file("walls.obj") + " --out " + image_);
  std::filesystem::remove(file("2.json"));
  printed(work + " --piece 2/2 --out " + file("2.json"));
  const Outcome outcome = hitpipe(join);
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr(image_));
}

/// An octahedron, which is closed.
class TraceEdgeRays : public testing::Test {
 protected:
  void SetUp() override {
    folder_.write("solid.obj",
                  "v 1 0 0\nv -1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nv 0 0 -1\n"
                  "f 1 3 5\nf 3 2 5\nf 2 4 5\nf 4 1 5\nf 3 1 6\nf 2 3 6\nf 4 2 6\nf 1 4 6\n");
  }
  [[nodiscard]] std::string file(const std::string& name) const { return (folder_.path() / name).string(); }
  [[nodiscard]] std::string traced(const std::string& more) const { return printed(words_ + more); }
  [[nodiscard]] nlohmann::json row(const std::string& more) const {
    return nlohmann::json::parse(traced(more)).at(0);
  }

  const sim::TemporaryFolder folder_;
  const std::string words_ =
      "core trace --bits 12+1s12 --questions nearest,any,count,next --format json --scene " +
      file("solid.obj") + " --edge-rays ";
};

TEST_F(TraceEdgeRays, OfAClosedMeshHaveEvenCountsFromOutside) {
  const nlohmann::json verilog = row("4001 --ask count");
  for (const char* const each : {"rays", "counts"}) EXPECT_EQ(verilog.at(each), 4001) << each;
  for (const char* const each : {"wrong", "odd_counts", "nexts"}) EXPECT_EQ(verilog.at(each), 0) << each;
  EXPECT_EQ(verilog.at("closed"), true);
  EXPECT_GT(verilog.at("outside_rays"), 1000);
  EXPECT_GT(verilog.at("ties_settled"), 4000);
  const nlohmann::json all = row("500 --native --parts 4");
  EXPECT_EQ(all.at("wrong"), 0);
  for (const char* const each : {"nearests", "anys", "counts"}) EXPECT_EQ(all.at(each), 500) << each;
  EXPECT_EQ(all.at("nexts"), all.at("crossings").get<int>() + 500);
  const nlohmann::json alone = row("500 --native --ask count");
  for (const char* const each : {"crossings", "ties_settled", "outside_rays"})
    EXPECT_EQ(alone.at(each), all.at(each)) << each;
  EXPECT_NE(row("500 --native --ask count --seed 2").at("crossings"), all.at("crossings"));
}

TEST_F(TraceEdgeRays, AreTracedInPieces) {
  const std::string work = "500 --native --ask count --parts 2";
  for (const std::string piece : {"1", "2"})
    printed(words_ + work + " --piece " + piece + "/2 --out " + file(piece));
  EXPECT_EQ(printed("core trace --format json --join " + file("1") + " " + file("2")), traced(work));
}

/// Nothing is said of a count's parity.
TEST_F(TraceEdgeRays, OfAnOpenMeshAreCounted) {
  folder_.write("solid.obj", "v 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\n");
  const nlohmann::json open = row("500 --ask count");
  EXPECT_EQ(open.at("closed"), false);
  EXPECT_EQ(open.at("outside_rays"), 0);
  EXPECT_EQ(open.at("wrong"), 0);
  EXPECT_GT(open.at("crossings"), 50);
}

TEST_F(TraceEdgeRays, RefusedWhereTheyMakeNoSense) {
  const auto err = [](const std::string& more) {
    const Outcome outcome = hitpipe("core trace --scene city " + more);
    EXPECT_EQ(outcome.exit_code, 2) << more;
    return outcome.err;
  };
  EXPECT_EQ(err("--edge-rays 5"),
            "hitpipe: --edge-rays: the core has no count of crossings; needs --questions "
            "nearest,any,count,next\n");
  EXPECT_THAT(err("--seed 5"), HasSubstr("--seed: needs --edge-rays"));
  EXPECT_THAT(err("--ask count"), HasSubstr("--ask: needs --edge-rays"));
  const std::string core = "--questions nearest,any,count,next --edge-rays 5 ";
  EXPECT_THAT(err(core + "--rays a.csv"), HasSubstr("--edge-rays excludes --rays: rays come from one place"));
  for (const std::string picture : {"--width 9", "--height 9", "--out a"})
    EXPECT_THAT(err(core + picture), HasSubstr(": rays at edges make no picture"));
  EXPECT_THAT(err(core + "--parts 6"), HasSubstr("--parts 6: there are 5 rays; allowed is 1 to 5"));
  EXPECT_THAT(err(core + "--edge-rays 0"), HasSubstr("Value 0 not in range 1 to 1000000000"));
}

TEST(TraceCommand, RefusesWhatItCannotDo) {
  const auto refused = [](const std::vector<std::string>& more) {
    const Outcome outcome = run_hitpipe(words(more));
    EXPECT_EQ(outcome.exit_code, 2);
    return outcome.err;
  };
  EXPECT_THAT(refused({"--rays-in-flight", "257"}), HasSubstr("1 to 256"));
  EXPECT_THAT(refused({"--stack", "7"}), HasSubstr("--stack 7: allowed is a power of two from 2 to 64"));
  EXPECT_THAT(refused({"--memory", "ideal,latency=9..3"}),
              HasSubstr("memory ideal: latency is 9..3; allowed is the least, and then the most"));
  EXPECT_THAT(refused({"--cache", "3"}), HasSubstr("power of two"));
  EXPECT_THAT(refused({"--cache", "128", "--cache-line", "32"}), HasSubstr("allowed is up to 64 with these"));
  EXPECT_THAT(refused({"--bits", "20/24"}), HasSubstr("n+gsS"));
  EXPECT_THAT(refused({"--triangle-ii", "2"}), HasSubstr("3 to 64"));
}

}  // namespace
}  // namespace hitpipe::cli::trace_command_test
