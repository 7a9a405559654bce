// `hitpipe cosim`: every number of the verification in three formats, and the files of the run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/program.hpp"

namespace hitpipe::cli::cosim_command_test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::StartsWith;

std::vector<std::string> cosim(const std::vector<std::string>& more) {
  return with({"cosim", "int_slabs", "--scene", "spheres", "--width", "40", "--height", "30"}, more);
}

TEST(CosimCommand, PrintsEveryNumberAsJson) {
  const Outcome outcome = run_hitpipe(cosim({"--referee", "--format", "json"}));
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
  const json object = json::parse(outcome.out);
  for (const char* const key : {"design", "bits", "scene"}) EXPECT_TRUE(object.at(key).is_string()) << key;
  for (const char* const key :
       {"triangles", "bvh_nodes", "rays_primary", "rays_secondary", "rays_shadow", "box_tests", "hits",
        "rtl_mismatches", "false_misses", "false_hits", "different_triangles", "cycles", "latency",
        "degenerate_dropped", "rays_rejected", "rays_in_flight"}) {
    EXPECT_TRUE(object.at(key).is_number_unsigned() || object.at(key) >= 0) << key;
    EXPECT_TRUE(object.at(key).is_number_integer()) << key;
  }
  for (const char* const key : {"extra_box_tests_pct", "extra_triangle_tests_pct", "occupancy_pct",
                                "rtl_tests_per_s", "loop_tests_per_s"}) {
    EXPECT_TRUE(object.at(key).is_number_float()) << key;
  }
  EXPECT_EQ(object.at("design"), "int_slabs");
  EXPECT_EQ(object.at("bits"), "20/24");  // the default
  EXPECT_EQ(object.at("scene"), "spheres");
  EXPECT_EQ(object.at("triangles"), 24578);
  EXPECT_EQ(object.at("rays_primary"), 1200);
  EXPECT_GE(object.at("rays_secondary"), 0);
  EXPECT_EQ(object.at("rays_rejected"), 0);
  EXPECT_EQ(object.at("rtl_mismatches"), 0);
  EXPECT_EQ(object.at("bit_level_tests"), object.at("box_tests"));
  EXPECT_EQ(object.at("false_misses"), 0);
  EXPECT_EQ(object.at("different_triangles"), 0);
  EXPECT_GT(object.at("rays_shadow"), 100);
  EXPECT_GT(object.at("box_tests"), object.at("hits"));
  EXPECT_GT(object.at("hits"), object.at("false_hits"));
  EXPECT_GE(object.at("cycles"), object.at("box_tests"));
  EXPECT_EQ(object.at("latency"), 4);
  EXPECT_EQ(object.at("rays_in_flight"), 32);
  EXPECT_GE(object.at("extra_box_tests_pct"), 0.0);
  EXPECT_GT(object.at("occupancy_pct"), 90.0);
  EXPECT_GT(object.at("rtl_tests_per_s"), 0.0);
  EXPECT_GT(object.at("loop_tests_per_s"), 0.0);
  EXPECT_FALSE(object.contains("image"));
}

/// Tests through the pipeline, and the boxes that they answered for.
TEST(CosimCommand, PrintsTestsAndBoxesOfAPair) {
  const Outcome outcome = run_hitpipe({"cosim", "int_major_pair", "--bits", "12+1/12", "--scene", "spheres",
                                       "--width", "16", "--height", "12", "--referee", "--format", "json"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const json pair = json::parse(outcome.out);
  const auto number = [&](const char* key) { return pair.at(key).get<double>(); };
  const double boxes_per_test = number("box_tests") / number("unit_tests");
  EXPECT_GT(boxes_per_test, 1.5);
  EXPECT_LE(boxes_per_test, 2.0);
  EXPECT_NEAR(number("rtl_boxes_per_s"), boxes_per_test * number("rtl_tests_per_s"), 1.0);
  EXPECT_NEAR(number("loop_boxes_per_s"), boxes_per_test * number("loop_tests_per_s"), 1.0);
  EXPECT_NEAR(number("occupancy_pct"), 100.0 * number("unit_tests") / number("cycles"), 1e-9);
  EXPECT_LE(number("occupancy_pct"), 100.0);
  const json one = json::parse(run_hitpipe(cosim({"--format", "json"})).out);
  for (const char* const key : {"unit_tests", "rtl_boxes_per_s", "loop_boxes_per_s"})
    EXPECT_FALSE(one.contains(key)) << key;
}

TEST(CosimCommand, BoxesOfTheIntegerWorldAreAnsweredByThePairUnit) {
  const std::vector<std::string> scene{"--scene", "spheres", "--width", "24", "--height", "24"};
  const Outcome outcome = run_hitpipe(
      with(with({"cosim", "int_triangle"}, scene), {"--box-unit", "int_major_pair", "--format", "json"}));
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
  const json object = json::parse(outcome.out);
  EXPECT_EQ(object.at("box_unit"), "int_major_pair");
  for (const char* const key : {"box_rtl_mismatches", "triangle_rtl_mismatches", "different_rays"})
    EXPECT_EQ(object.at(key), 0) << key;
  const auto number = [&](const char* key) { return object.at(key).get<std::uint64_t>(); };
  const std::uint64_t rays = number("rays_primary") + number("rays_secondary") + number("rays_shadow");
  EXPECT_EQ(number("box_tests"), 2 * number("box_unit_tests") - rays);
  EXPECT_GT(number("box_hits"), 10'000U);

  const Outcome of_boxes =
      run_hitpipe(with(with({"cosim", "int_slabs"}, scene), {"--box-unit", "int_major_pair"}));
  EXPECT_EQ(of_boxes.exit_code, 2);
  EXPECT_EQ(of_boxes.err, "hitpipe: --box-unit: not for design int_slabs, which tests boxes\n");
}

TEST(CosimCommand, FollowsRaysInRandomDirections) {
  const auto number = [](const json& object, const char* key) { return object.at(key).get<std::uint64_t>(); };
  const std::vector<std::string> judged{"--referee", "--format", "json"};
  const json usual = json::parse(run_hitpipe(cosim(judged)).out);
  const Outcome outcome = run_hitpipe(cosim(with({"--diffuse", "1", "--occlusion", "2"}, judged)));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const json random = json::parse(outcome.out);
  for (const char* const key : {"rtl_mismatches", "false_misses", "different_triangles"})
    EXPECT_EQ(random.at(key), 0) << key;
  EXPECT_GT(number(random, "rays_secondary"), number(usual, "rays_secondary") + 500);
  EXPECT_GT(number(random, "rays_shadow"), number(usual, "rays_shadow") + 1000);
  const json other = json::parse(
      run_hitpipe(cosim(with({"--diffuse", "1", "--occlusion", "2", "--light-seed", "2"}, judged))).out);
  EXPECT_NE(other.at("box_tests"), random.at("box_tests"));
}

/// Boxes alone, and boxes and triangles.
TEST(CosimCommand, TracesTheRaysOfAFile) {
  const sim::TemporaryFolder folder;
  const std::string rays =
      folder
          .write(
              "rays.csv",
              "ox,oy,oz,dx,dy,dz,length,any\n0,9,0,0,-1,0,inf,0\n0,9,0,0.1,-1,0,inf,1\n0,9,0,0,-1,0,0.5,0\n")
          .string();
  const std::vector<std::string> words{"--scene", "spheres", "--rays", rays, "--format", "json"};
  const std::filesystem::path out = folder.path() / "out";
  const Outcome boxes = run_hitpipe(with({"cosim", "int_slabs", "--referee", "--out", out.string()}, words));
  EXPECT_EQ(boxes.exit_code, 0) << boxes.err;
  const Outcome triangles = run_hitpipe(with({"cosim", "int_triangle"}, words));
  EXPECT_EQ(triangles.exit_code, 0) << triangles.err;
  for (const Outcome& outcome : {boxes, triangles}) {
    const json object = json::parse(outcome.out);
    EXPECT_EQ(object.at("rays_primary"), 2);
    EXPECT_EQ(object.at("rays_secondary"), 0);
    EXPECT_EQ(object.at("rays_shadow"), 1);
    EXPECT_GT(object.at("box_tests"), 10);
    EXPECT_FALSE(object.contains("image"));
  }
  EXPECT_FALSE(std::filesystem::exists(out / "spheres.png"));
  EXPECT_TRUE(std::filesystem::exists(out / "int_slabs.v")) << boxes.out;
  const Outcome picture = run_hitpipe(with({"cosim", "int_triangle", "--out", out.string()}, words));
  EXPECT_EQ(picture.exit_code, 2);
  EXPECT_EQ(picture.err,
            "hitpipe: --out: a triangle unit's cosim writes a picture only, and --rays make none\n");
}

TEST(CosimCommand, SaysThatNothingWasJudgedWithoutReferee) {
  const json object = json::parse(run_hitpipe(cosim({"--format", "json"})).out);
  EXPECT_TRUE(object.at("false_misses").is_null());
  EXPECT_TRUE(object.at("false_hits").is_null());
  EXPECT_THAT(run_hitpipe(cosim({})).out, HasSubstr("\nfalse_misses              not judged\n"));
}

TEST(CosimCommand, PrintsTextThatFitsEightyColumnsAndCsv) {
  const Outcome text = run_hitpipe(cosim({"--referee"}));
  EXPECT_EQ(text.exit_code, 0);
  EXPECT_LE(widest_line(text.out), 80U);
  EXPECT_THAT(text.out, StartsWith("design                    int_slabs\n"
                                   "bits                      20/24\n"
                                   "scene                     spheres\n"
                                   "triangles                 24,578\n"));
  const Outcome csv = run_hitpipe(cosim({"--format", "csv"}));
  const auto lines = lines_of(csv.out);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0],
            "design,bits,scene,triangles,degenerate_dropped,lost_to_rounding,mesh_share_of_cube_pct,bvh_"
            "nodes,hierarchy,rays_primary,rays_secondary,"
            "rays_shadow,rays_rejected,box_tests,hits,rtl_mismatches,bit_level_tests,false_misses,false_hits,"
            "different_"
            "triangles,"
            "extra_box_tests_pct,extra_triangle_tests_pct,cycles,latency,rays_in_flight,occupancy_pct,"
            "rtl_tests_per_s,loop_tests_per_s");
  EXPECT_THAT(lines[1], StartsWith("int_slabs,n20/24,spheres,24578,0,"));
}

TEST(CosimCommand, FlowControlIsTheUnitsOwn) {
  const sim::TemporaryFolder folder;
  const std::string out = (folder.path() / "unit").string();
  ASSERT_EQ(run_hitpipe({"rtl", "int_slabs", "--flow-control", "none", "--out", out}).exit_code, 0);
  const Outcome read = run_hitpipe(cosim({"--unit", out, "--format", "json"}));
  EXPECT_EQ(read.exit_code, 0) << read.err;
  EXPECT_EQ(json::parse(read.out).at("rtl_mismatches"), 0);
}

TEST(CosimCommand, WritesImageVerilogAndSchematicWhereTold) {
  const sim::TemporaryFolder folder;
  const std::filesystem::path out = folder.path() / "a" / "b";
  const Outcome outcome = run_hitpipe(cosim({"--out", out.string(), "--format", "json"}));
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(files_below(out),
            (std::vector<std::string>{
                "int_slabs.core", "int_slabs.json", "int_slabs.v", "int_slabs_stage_1.dot",
                "int_slabs_stage_1.svg", "int_slabs_stage_4.dot", "int_slabs_stage_4.svg",
                "int_slabs_stages_2-3.dot", "int_slabs_stages_2-3.svg", "spheres.png", "tb/Makefile",
                "tb/int_slabs_harness.cpp", "tb/int_slabs_tb.sv", "tb/int_slabs_vectors.hex"}));
  const json object = json::parse(outcome.out);
  EXPECT_EQ(object.at("image"), (out / "spheres.png").string());
  EXPECT_EQ(object.at("verilog"), (out / "int_slabs.v").string());
  EXPECT_EQ(object.at("schematics"),
            json({(out / "int_slabs_stage_1.svg").string(), (out / "int_slabs_stages_2-3.svg").string(),
                  (out / "int_slabs_stage_4.svg").string()}));
  // The image is the software renderer's, byte for byte.
  const std::string image = (folder.path() / "software.png").string();
  ASSERT_EQ(run_hitpipe({"render", "--scene", "spheres", "--width", "40", "--height", "30", "--out", image})
                .exit_code,
            0);
  EXPECT_EQ(contents_of(out / "spheres.png"), contents_of(image));
}

TEST(CosimCommand, FindsTheUnitInItsFolderByItsManifest) {
  const sim::TemporaryFolder folder;
  const std::string out = (folder.path() / "rtl").string();
  const auto unit = [](const std::string& place) {
    return run_hitpipe({"cosim", "int_slabs", "--unit", place, "--scene", "spheres", "--width", "16",
                        "--height", "16", "--format", "json"});
  };
  ASSERT_EQ(run_hitpipe({"rtl", "fp_slabs", "--out", out}).exit_code, 0);
  ASSERT_EQ(
      run_hitpipe({"rtl", "int_slabs", "--bits", "12/12", "--name", "box_test", "--out", out}).exit_code, 0);
  const Outcome named = unit(out);
  EXPECT_EQ(named.exit_code, 0) << named.err;
  EXPECT_EQ(json::parse(named.out).at("bits"), "12/12");

  ASSERT_EQ(run_hitpipe({"rtl", "int_slabs", "--out", out}).exit_code, 0);
  const std::string one = (folder.path() / "rtl/box_test.json").string();
  EXPECT_EQ(unit(out).err, "hitpipe: " + out + ": 2 units of int_slabs; give the manifest of one: " + one +
                               ", " + out + "/int_slabs.json\n");
  EXPECT_EQ(json::parse(unit(one).out).at("bits"), "12/12");

  std::filesystem::create_directory(folder.path() / "empty");
  const std::string empty = (folder.path() / "empty").string();
  EXPECT_EQ(unit(empty).err, "hitpipe: " + empty +
                                 ": no manifest of int_slabs; give a folder that `hitpipe fit` or `hitpipe "
                                 "rtl` wrote for it\n");
}

TEST(CosimCommand, ReadsMeshFilesAndCountsWhatItDrops) {
  const sim::TemporaryFolder folder;
  const std::string mesh = folder
                               .write("two.obj",
                                      "v 0 0 0\nv 4 0 0\nv 0 3 0\nv 4 3 1\nv 8 0 0\n"
                                      "f 1 2 3\nf 2 4 3\nf 1 2 5\nf 3 3 4\n")
                               .string();
  const Outcome outcome = run_hitpipe({"cosim", "int_slabs", "--scene", mesh, "--width", "16", "--height",
                                       "16", "--referee", "--format", "json"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const json object = json::parse(outcome.out);
  EXPECT_EQ(object.at("scene"), "two");
  EXPECT_EQ(object.at("triangles"), 2);
  EXPECT_EQ(object.at("degenerate_dropped"), 2);
  EXPECT_EQ(object.at("different_triangles"), 0);
  EXPECT_GT(object.at("rays_shadow"), 0);
}

/// A library says where the registers are. It changes the time of an answer and no answer.
TEST(CosimCommand, SchedulesByAnotherLibrary) {
  json own = json::parse(run_hitpipe(cosim({"--format", "json"})).out);
  const sim::TemporaryFolder folder;
  const std::string out = folder.path() / "unit";
  const Outcome outcome = run_hitpipe(cosim({"--library", "xc7", "--out", out, "--format", "json"}));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  json other = json::parse(outcome.out);
  EXPECT_EQ(other.at("library"), "xc7");
  EXPECT_FALSE(own.contains("library"));
  EXPECT_NE(other.at("latency"), own.at("latency"));
  const Outcome written =
      run_hitpipe({"rtl", "int_slabs", "--library", "xc7", "--out", folder.path() / "rtl"});
  EXPECT_EQ(written.exit_code, 0) << written.err;
  EXPECT_EQ(contents_of(out + "/int_slabs.v"), contents_of(folder.path() / "rtl/int_slabs.v"));
  for (const char* const key : {"library", "image", "verilog", "schematics", "cycles", "latency",
                                "occupancy_pct", "rtl_tests_per_s", "loop_tests_per_s"}) {
    own.erase(key);
    other.erase(key);
  }
  EXPECT_EQ(own, other);
}

TEST(CosimCommand, ReadsAUnitOfAnotherLibrary) {
  const sim::TemporaryFolder folder;
  const std::string unit = folder.path() / "rtl";
  ASSERT_EQ(run_hitpipe({"rtl", "int_slabs", "--library", "xc7", "--out", unit}).exit_code, 0);
  const Outcome without = run_hitpipe(cosim({"--unit", unit}));
  EXPECT_EQ(without.exit_code, 2);
  EXPECT_THAT(without.err,
              HasSubstr("but with the library thesis_250nm it is 4; give the library that it was "
                        "written with, or write the unit again\n"));
  const Outcome with = run_hitpipe(cosim({"--unit", unit, "--library", "xc7", "--format", "json"}));
  EXPECT_EQ(with.exit_code, 0) << with.err;
  EXPECT_EQ(json::parse(with.out).at("rtl_mismatches"), 0);
}

/// Verilog that never answers is wrong hardware too.
TEST(CosimCommand, VerilogThatNeverAnswersFails) {
  const sim::TemporaryFolder folder;
  const std::string verilator = folder
                                    .write_program("verilator", R"script(#!/bin/sh
if [ "$1" = --version ]; then echo 'never answers'; exit; fi
if [ "$1" = --cc ]; then
  for file; do :; done
  sed -i 's/assign out_valid = .*;/assign out_valid = 0;/' "$file"
fi
exec verilator "$@"
)script")
                                    .string();
  const Outcome outcome = run_hitpipe(
      {"cosim", "int_slabs", "--bits", "12/12", "--scene", "spheres", "--width", "4", "--height", "4"},
      {{"VERILATOR", verilator}});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err, "hitpipe: int_slabs_12_12: no answer to a test within its latency\n");
}

/// Verilog that always misses: the counts are printed, then one line, and the exit code is not 0. Without a
/// referee nothing is said about false misses.
TEST(CosimCommand, WrongVerilogFails) {
  const sim::TemporaryFolder folder;
  const Variables wrong{{"VERILATOR", always_missing_verilator(folder)}};
  for (const bool judged : {true, false}) {
    const Outcome outcome = hitpipe(
        std::string("cosim int_slabs --bits 12/12 --scene spheres --width 4 --height 4 --format json") +
            (judged ? " --referee" : ""),
        wrong);
    EXPECT_EQ(outcome.exit_code, 1);
    const json object = json::parse(outcome.out);
    // Every primary ray ends at the root. The Verilog misses it where the software finds a triangle, and
    // maybe elsewhere.
    EXPECT_EQ(object.at("hits"), 0);
    EXPECT_EQ(object.at("box_tests"), 16);
    EXPECT_GT(object.at("different_triangles"), 4);
    EXPECT_GE(object.at("rtl_mismatches"), object.at("different_triangles"));
    const std::string false_misses = judged ? ", " + object.at("false_misses").dump() + " false misses" : "";
    EXPECT_EQ(outcome.err, "hitpipe: int_slabs 12/12 on spheres: " + object.at("rtl_mismatches").dump() +
                               " RTL mismatches, " + object.at("different_triangles").dump() +
                               " different triangles" + false_misses + "; all must be 0\n");
  }
}

TEST(CosimRescale, JudgesTheVerilogInOtherUnitsAndPlaces) {
  const std::string words = "cosim --rescale --scene spheres --width 40 --height 30 int_slabs ";
  const std::string text = printed(words + "--scale 2^-100 --scale 1024");
  EXPECT_LE(widest_line(text), 80U);
  const auto lines = lines_of(text);
  ASSERT_EQ(lines.size(), 4U);
  EXPECT_EQ(lines[0], "spheres: 12316 vertices, 1200 pixels, int_slabs 20/24");
  EXPECT_THAT(lines[1], testing::EndsWith(" different  rtl"));
  EXPECT_THAT(lines[2], testing::ContainsRegex(" 0 +0 +0 +0 +0 +0$"));
  const json rows =
      json::parse(printed(words + "--scale 0.1 --offset 0,0,0 --offset 1e6,1e6,1e6 --format json"));
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_GT(rows[0].at("vertices_moved"), 6000);
  EXPECT_EQ(rows[1].at("transform"), "+0,0,0");
  EXPECT_EQ(rows[1].at("vertices_moved"), 0);
  EXPECT_GT(rows[2].at("pixels_other_triangle"), 10);
  for (const json& row : rows) {
    EXPECT_EQ(row.at("different_triangles"), 0);
    EXPECT_EQ(row.at("rtl_mismatches"), 0);
  }
}

}  // namespace
}  // namespace hitpipe::cli::cosim_command_test
