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
  std::vector<std::string> arguments{"cosim",   "int_slabs", "--scene",  "spheres",
                                     "--width", "40",        "--height", "30"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
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

/// Counts agree with those of the software renderer: extra_box_tests_pct is 100 (RTL / reference - 1).
TEST(CosimCommand, ExtraTestsAreOverTheSoftwareTraversal) {
  const json rtl = json::parse(run_hitpipe(cosim({"--bits", "12/12", "--format", "json"})).out);
  const Outcome outcome =
      run_hitpipe({"render", "--scene", "spheres", "--width", "40", "--height", "30", "--format", "json"});
  const json software = json::parse(outcome.out);
  EXPECT_EQ(rtl.at("rays_secondary"), software.at("rays_secondary"));
  EXPECT_EQ(rtl.at("rays_shadow"), software.at("rays_shadow"));
  EXPECT_EQ(rtl.at("bvh_nodes"), software.at("bvh_nodes"));
  EXPECT_GT(rtl.at("extra_box_tests_pct"), 1.0);
  EXPECT_NEAR(rtl.at("extra_box_tests_pct").get<double>(),
              100.0 * (rtl.at("box_tests").get<double>() / software.at("box_tests").get<double>() - 1.0),
              1e-9);
}

/// The host's floating-point unit judges most tests of a float design, unless told otherwise.
TEST(CosimCommand, ComparesAShareOfFloatTestsBitByBitOrAllOfThem) {
  std::vector<std::string> words{"cosim", "fp_slabs", "--scene", "spheres",  "--width",
                                 "16",    "--height", "12",      "--format", "json"};
  const Outcome share = run_hitpipe(words);
  EXPECT_EQ(share.exit_code, 0) << share.err;
  words.emplace_back("--bit-level");
  const Outcome all = run_hitpipe(words);
  EXPECT_EQ(all.exit_code, 0) << all.err;
  json of_share = json::parse(share.out);
  json of_all = json::parse(all.out);
  EXPECT_EQ(of_share.at("rtl_mismatches"), 0);
  const int tests = of_share.at("box_tests");
  EXPECT_EQ(of_all.at("bit_level_tests"), tests);
  // One unit for each tile of 64 x 64 pixels; here there is one.
  EXPECT_EQ(of_share.at("bit_level_tests"), (tests + 60) / 61);
  for (const char* const key : {"bit_level_tests", "rtl_tests_per_s", "loop_tests_per_s"}) {
    of_share.erase(key);
    of_all.erase(key);
  }
  EXPECT_EQ(of_share, of_all);
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
  EXPECT_EQ(
      lines[0],
      "design,bits,scene,triangles,degenerate_dropped,bvh_nodes,rays_primary,rays_secondary,rays_shadow,"
      "rays_rejected,box_tests,hits,rtl_mismatches,bit_level_tests,false_misses,false_hits,different_"
      "triangles,"
      "extra_box_tests_pct,extra_triangle_tests_pct,cycles,latency,rays_in_flight,occupancy_pct,"
      "rtl_tests_per_s,loop_tests_per_s");
  EXPECT_THAT(lines[1], StartsWith("int_slabs,20/24,spheres,24578,0,"));
}

/// The unit behind ray slots answers the same, and is sent less.
TEST(CosimCommand, RaySlotsAreTheUnitWithFewerBits) {
  const sim::TemporaryFolder folder;
  const Outcome outcome = run_hitpipe(cosim({"--ray-slots", "20", "--rays-in-flight", "24", "--out",
                                             folder.path().string(), "--referee", "--format", "json"}));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const json slots = json::parse(outcome.out);
  const json bare = json::parse(run_hitpipe(cosim({"--referee", "--format", "json"})).out);
  for (const char* const same :
       {"box_tests", "hits", "rtl_mismatches", "false_misses", "false_hits", "rays_shadow"})
    EXPECT_EQ(slots.at(same), bare.at(same)) << same;
  EXPECT_EQ(slots.at("latency"), bare.at("latency").get<int>() + 1);
  EXPECT_EQ(slots.at("ray_slots"), 32);
  const int rays = slots.at("rays_primary").get<int>() + slots.at("rays_secondary").get<int>() +
                   slots.at("rays_shadow").get<int>() - slots.at("rays_rejected").get<int>();
  EXPECT_EQ(slots.at("ray_writes"), rays);
  EXPECT_GT(slots.at("ray_end_writes"), 0);
  // 15 words of 20 bits, the length and its flag. A test has six of the words and a slot.
  EXPECT_EQ(slots.at("bits_per_box_test_without_slots"), 325.0);
  const double tests = slots.at("box_tests");
  const double writes =
      211.0 * slots.at("ray_writes").get<double>() + 31.0 * slots.at("ray_end_writes").get<double>();
  EXPECT_NEAR(slots.at("bits_per_box_test").get<double>(), 125.0 + writes / tests, 1e-9);
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "int_slabs_slots.v"));
  EXPECT_FALSE(bare.contains("ray_slots"));
}

TEST(CosimCommand, AUnitWithoutFlowControlTracesTheSameRays) {
  const Outcome none = run_hitpipe(cosim({"--referee", "--flow-control", "none", "--format", "json"}));
  EXPECT_EQ(none.exit_code, 0) << none.err;
  json object = json::parse(none.out);
  json stall = json::parse(run_hitpipe(cosim({"--referee", "--format", "json"})).out);
  EXPECT_EQ(object.at("rtl_mismatches"), 0);
  for (const char* const key : {"rtl_tests_per_s", "loop_tests_per_s"}) {
    object.erase(key);
    stall.erase(key);
  }
  EXPECT_EQ(object, stall);
}

TEST(CosimCommand, FlowControlIsTheUnitsOwn) {
  const sim::TemporaryFolder folder;
  const std::string out = (folder.path() / "unit").string();
  ASSERT_EQ(run_hitpipe({"rtl", "int_slabs", "--flow-control", "none", "--out", out}).exit_code, 0);
  const Outcome read = run_hitpipe(cosim({"--unit", out, "--format", "json"}));
  EXPECT_EQ(read.exit_code, 0) << read.err;
  EXPECT_EQ(json::parse(read.out).at("rtl_mismatches"), 0);
  const Outcome both = run_hitpipe(cosim({"--unit", out, "--flow-control", "none"}));
  EXPECT_NE(both.exit_code, 0);
  EXPECT_THAT(both.err, HasSubstr("--unit excludes --flow-control"));
  const Outcome slots = run_hitpipe(cosim({"--unit", out, "--ray-slots", "32"}));
  EXPECT_NE(slots.exit_code, 0);
  EXPECT_EQ(slots.err, "hitpipe: ray slots: flow control none; allowed is stall\n");
}

TEST(CosimCommand, RaysInFlightWithoutASlotAreRefused) {
  const Outcome outcome = run_hitpipe(cosim({"--ray-slots", "16"}));
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err, "hitpipe: 32 rays in flight: each needs a slot, and there are 16 ray slots\n");
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
  EXPECT_THAT(without.err, HasSubstr("is that of the library thesis_250nm; give the library that it was "
                                     "written with, or write the unit again\n"));
  const Outcome with = run_hitpipe(cosim({"--unit", unit, "--library", "xc7", "--format", "json"}));
  EXPECT_EQ(with.exit_code, 0) << with.err;
  EXPECT_EQ(json::parse(with.out).at("rtl_mismatches"), 0);
}

/// Threads and rays in flight change the speed, not the result. No warning about the number of threads
/// appears.
TEST(CosimCommand, CountsDoNotDependOnThreadsOrRaysInFlight) {
  json usual = json::parse(run_hitpipe(cosim({"--format", "json"})).out);
  for (const std::vector<std::string>& how : {std::vector<std::string>{"--threads", "1"},
                                              {"--threads", "64"},
                                              {"--rays-in-flight", "1"},
                                              {"--rays-in-flight", "65536"}}) {
    std::vector<std::string> arguments = how;
    arguments.insert(arguments.end(), {"--format", "json"});
    const Outcome outcome = run_hitpipe(cosim(arguments));
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.err, "");
    json object = json::parse(outcome.out);
    for (const char* const key :
         {"cycles", "occupancy_pct", "rays_in_flight", "rtl_tests_per_s", "loop_tests_per_s"}) {
      object.erase(key);
      usual.erase(key);
    }
    EXPECT_EQ(object, usual) << how[0] << " " << how[1];
  }
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
  EXPECT_EQ(outcome.err, "hitpipe: the Verilog did not answer a box test within its latency\n");
}

/// Without a referee nothing is printed about false misses.
TEST(CosimCommand, WrongVerilogFailsWithoutRefereeToo) {
  const sim::TemporaryFolder folder;
  const std::string verilator = folder
                                    .write_program("verilator", R"script(#!/bin/sh
if [ "$1" = --version ]; then echo 'always misses'; exit; fi
if [ "$1" = --cc ]; then
  for file; do :; done
  sed -i 's/assign hit = .*;/assign hit = 0;/' "$file"
fi
exec verilator "$@"
)script")
                                    .string();
  const Outcome outcome = run_hitpipe({"cosim", "int_slabs", "--bits", "12/12", "--scene", "spheres",
                                       "--width", "4", "--height", "4", "--format", "json"},
                                      {{"VERILATOR", verilator}});
  EXPECT_EQ(outcome.exit_code, 1);
  const json object = json::parse(outcome.out);
  EXPECT_EQ(outcome.err, "hitpipe: int_slabs 12/12 on spheres: " + object.at("rtl_mismatches").dump() +
                             " RTL mismatches, " + object.at("different_triangles").dump() +
                             " different triangles; all must be 0\n");
}

/// Verilog that always misses: the counts are printed, then one line, and the exit code is not 0.
TEST(CosimCommand, WrongVerilogFails) {
  const sim::TemporaryFolder folder;
  const std::string verilator = always_missing_verilator(folder);
  const Outcome outcome = run_hitpipe({"cosim", "int_slabs", "--bits", "12/12", "--scene", "spheres",
                                       "--width", "4", "--height", "4", "--referee", "--format", "json"},
                                      {{"VERILATOR", verilator}});
  EXPECT_EQ(outcome.exit_code, 1);
  const json object = json::parse(outcome.out);
  // Every primary ray ends at the root. The Verilog misses it where the software finds a triangle, and maybe
  // elsewhere.
  EXPECT_EQ(object.at("hits"), 0);
  EXPECT_EQ(object.at("box_tests"), 16);
  EXPECT_GT(object.at("different_triangles"), 4);
  EXPECT_GE(object.at("false_misses"), object.at("different_triangles"));
  EXPECT_GE(object.at("rtl_mismatches"), object.at("false_misses"));
  EXPECT_EQ(outcome.err, "hitpipe: int_slabs 12/12 on spheres: " + object.at("rtl_mismatches").dump() +
                             " RTL mismatches, " + object.at("different_triangles").dump() +
                             " different triangles, " + object.at("false_misses").dump() +
                             " false misses; all must be 0\n");
}

}  // namespace
}  // namespace hitpipe::cli::cosim_command_test
