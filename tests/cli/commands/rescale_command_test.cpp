// `hitpipe rescale`: a scene in other units, with one row for each.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/program.hpp"

namespace hitpipe::cli::rescale_command_test {
namespace {

using nlohmann::json;
using testing::StartsWith;

std::vector<std::string> rescale(const std::vector<std::string>& more) {
  std::vector<std::string> arguments{"rescale", "--scene", "spheres", "--width", "40", "--height", "30"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

TEST(RescaleCommand, PowersOfTwoChangeNothing) {
  const Outcome outcome =
      run_hitpipe(rescale({"--scale", "2^-100", "--scale", "2^-10", "--scale", "1024", "--scale", "2^100",
                           "--design", "int_slabs", "--bits", "20/24", "--format", "json"}));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const json rows = json::parse(outcome.out);
  ASSERT_EQ(rows.size(), 4U);
  for (const json& row : rows) {
    for (const char* const key : {"vertices_moved", "degenerate_dropped", "pixels_other_triangle",
                                  "pixels_other_colour", "different_triangles", "rtl_mismatches"}) {
      EXPECT_EQ(row.at(key), 0) << row.at("transform") << " " << key;
    }
  }
  EXPECT_EQ(rows[0].at("transform"), "2^-100");
  EXPECT_EQ(rows[2].at("transform"), "1024");
}

TEST(RescaleCommand, CountsWhatAFarOffsetMoves) {
  const Outcome outcome = run_hitpipe(rescale({"--scale", "0.1", "--offset", "0,0,0", "--offset",
                                               "1e6,1e6,1e6", "--design", "int_slabs", "--format", "json"}));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const json rows = json::parse(outcome.out);
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_GT(rows[0].at("vertices_moved"), 6000);
  EXPECT_EQ(rows[1].at("transform"), "+0,0,0");
  EXPECT_EQ(rows[1].at("vertices_moved"), 0);
  EXPECT_EQ(rows[1].at("pixels_other_triangle"), 0);
  EXPECT_EQ(rows[2].at("transform"), "+1e6,1e6,1e6");
  EXPECT_GT(rows[2].at("vertices_moved"), 6000);
  EXPECT_GT(rows[2].at("pixels_other_triangle"), 10);
  EXPECT_LE(rows[2].at("pixels_other_triangle"), 1200);
  for (const json& row : rows) {
    EXPECT_EQ(row.at("different_triangles"), 0);
    EXPECT_EQ(row.at("rtl_mismatches"), 0);
  }
}

TEST(RescaleCommand, TriesBothKindsUnlessToldOtherwise) {
  const Outcome outcome = run_hitpipe(rescale({}));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_LE(widest_line(outcome.out), 80U);
  const auto lines = lines_of(outcome.out);
  ASSERT_EQ(lines.size(), 10U);
  EXPECT_EQ(lines[0], "spheres: 12316 vertices, 1200 pixels");
  EXPECT_THAT(lines[1], StartsWith("transform "));
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_THAT(lines[2 + i],
                StartsWith(std::vector<std::string>{"2^-100 ", "2^-10 ", "2^10 ", "2^100 "}[i]));
  }
  EXPECT_THAT(lines[2], testing::ContainsRegex(" 0 +0 +0 +0$"));
}

TEST(RescaleCommand, JudgesTheVerilogWithinEightyColumns) {
  const Outcome outcome = run_hitpipe(rescale({"--design", "int_slabs"}));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_LE(widest_line(outcome.out), 80U);
  const auto lines = lines_of(outcome.out);
  ASSERT_EQ(lines.size(), 10U);
  EXPECT_EQ(lines[0], "spheres: 12316 vertices, 1200 pixels, int_slabs 20/24");
  EXPECT_THAT(lines[1], testing::EndsWith(" different  rtl"));
  EXPECT_THAT(lines[2], testing::ContainsRegex(" 0 +0 +0 +0 +0 +0$"));
}

TEST(RescaleCommand, PrintsCsv) {
  const auto lines = lines_of(run_hitpipe(rescale({"--scale", "2", "--format", "csv"})).out);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0],
            "transform,vertices_moved,degenerate_dropped,pixels_other_triangle,pixels_other_colour,"
            "different_triangles,rtl_mismatches");
  EXPECT_EQ(lines[1], "2,0,0,0,0,,");
}

TEST(RescaleCommand, MeshFileIsMovedAsLoaded) {
  const sim::TemporaryFolder folder;
  const std::string mesh =
      folder.write("two.obj", "v 0 0 0\nv 4 0 0\nv 0 3 0\nv 4 3 1\nf 1 2 3\nf 2 4 3\n").string();
  const Outcome outcome = run_hitpipe({"rescale", "--scene", mesh, "--width", "16", "--height", "16",
                                       "--scale", "2^-100", "--offset", "4,4,4", "--format", "json"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const json& row : json::parse(outcome.out)) {
    EXPECT_EQ(row.at("vertices_moved"), 0);
    EXPECT_EQ(row.at("pixels_other_triangle"), 0);
    EXPECT_TRUE(row.at("different_triangles").is_null());
  }
}

/// Separated by commas or blanks, or the option repeated. An offset has commas of its own.
TEST(RescaleCommand, TakesListsInEveryForm) {
  const auto lists = [](const std::vector<std::string>& how) {
    std::vector<std::string> arguments = how;
    arguments.insert(arguments.end(), {"--format", "csv"});
    const Outcome outcome = run_hitpipe(rescale(arguments));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.out;
  };
  const std::string again = lists({"--scale", "2", "--scale", "3", "--offset", "1,2,3", "--offset", "4,5,6"});
  EXPECT_EQ(lines_of(again).size(), 5U);
  EXPECT_EQ(lists({"--scale", "2,3", "--offset", "1,2,3", "4,5,6"}), again);
  EXPECT_EQ(lists({"--offset", "1,2,3", "4,5,6", "--scale", "2", "3"}), again);
}

void expect_error(const std::vector<std::string>& more, const std::string& message) {
  const Outcome outcome = run_hitpipe(rescale(more));
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err, "hitpipe: " + message + "\n");
}

TEST(RescaleCommand, BadInputRejected) {
  const auto scale = [](const std::string& text) {
    return "--scale: " + text +
           " is not a scale; give a number above 0 or a power of two, for example 0.1 or 2^-10; see hitpipe "
           "rescale --help";
  };
  for (const char* const text : {"0", "2^", "2^2000", "inf", "1x", "three"}) {
    expect_error({"--scale", text}, scale(text));
  }
  for (const char* const text : {"1", "1,2", "1,2,3,4", "1,2,x", "1,2,3,", "1,2,inf"}) {
    expect_error({"--offset", text}, std::string("--offset: ") + text +
                                         " is not X,Y,Z; give three numbers, for example 1000,0,-0.5; see "
                                         "hitpipe rescale --help");
  }
  expect_error({"--bits", "20/24"}, "--bits: needs --design; see hitpipe rescale --help");
}

TEST(RescaleCommand, SceneThatDoesNotSurviveRejected) {
  const Outcome outcome = run_hitpipe(rescale({"--scale", "2^127"}));
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, StartsWith("hitpipe: transform 2^127: vertex "));
  EXPECT_THAT(outcome.err, testing::EndsWith(" leaves the range of binary32\n"));
  EXPECT_EQ(lines_of(outcome.err).size(), 1U);
}

}  // namespace
}  // namespace hitpipe::cli::rescale_command_test
