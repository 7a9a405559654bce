// `hitpipe stiffness`: tables, rows and plots.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "rtl_gen/catalogue/design.hpp"
#include "sim/software.hpp"
#include "sw_ref/scene/built_in.hpp"
#include "tests/cli/program.hpp"

namespace hitpipe::cli::stiffness_command_test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::StartsWith;

constexpr std::size_t ratios = 22;
constexpr std::size_t kinds = 7;  // of boxes: six, and all together

std::vector<std::string> stiffness(const std::vector<std::string>& more) {
  std::vector<std::string> arguments{"stiffness", "--tests", "600"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

TEST(StiffnessCommand, PrintsATableForEachDesignInEightyColumns) {
  const Outcome outcome = run_hitpipe(stiffness({}));
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
  EXPECT_LE(widest_line(outcome.out), 80U);
  const auto lines = lines_of(outcome.out);
  std::size_t at = 0;
  for (const rtl::Design& design : rtl::designs()) {
    if (!design.conservative || !sim::why_not_traced(design).empty()) continue;
    ASSERT_LT(at + 2 * ratios + 2, lines.size()) << design.name;
    EXPECT_EQ(lines[at], std::string(design.name) + ": false hits, % of the boxes that the ray misses");
    std::string head = "ratio  ";
    for (const rtl::Format& format : sim::stiffness_formats(design))
      head += fmt::format(" {:<8}", rtl::to_string(format));
    EXPECT_EQ(lines[at + 1], head.erase(head.find_last_not_of(' ') + 1));
    EXPECT_EQ(lines[at + 2 * ratios + 2], "");
    at += 2 * ratios + 3;
  }
  ASSERT_EQ(lines.size(), at + 1);
  EXPECT_EQ(lines[1], "ratio   24/24    20/24    16/16    12/12")
      << "of int_slabs, the first conservative one";
  EXPECT_THAT(lines[2], StartsWith("2^0 "));
  EXPECT_THAT(lines[3], StartsWith("+-95 % "));
  EXPECT_THAT(lines[42], StartsWith("2^40 "));
  EXPECT_THAT(lines[44], StartsWith("zero "));
  EXPECT_EQ(lines.back(), "600 tests a ratio; +-95 %: half the width of the 95 % interval");
}

TEST(StiffnessCommand, EightFormatsFitEightyColumns) {
  const Outcome outcome = run_hitpipe(stiffness({"--designs", "int_slabs", "--bits", "24/24", "24/28",
                                                 "24/32", "20/20", "20/24", "20/28", "16/16", "12/12"}));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_LE(widest_line(outcome.out), 80U);
}

TEST(StiffnessCommand, PrintsEveryKindOfBoxAsJson) {
  const Outcome outcome =
      run_hitpipe(stiffness({"--designs", "int_slabs", "--bits", "16/16", "--format", "json"}));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const json rows = json::parse(outcome.out);
  ASSERT_EQ(rows.size(), ratios * kinds);
  std::uint64_t false_hits_at_zero = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const json& row = rows[i];
    EXPECT_EQ(row.at("design"), "int_slabs");
    EXPECT_EQ(row.at("bits"), "16/16");
    const int tests = row.at("boxes") == "all" ? 600 : 100;
    EXPECT_EQ(row.at("tests"), tests);
    EXPECT_EQ(row.at("false_misses"), 0);
    EXPECT_LE(row.at("hits").get<int>() + row.at("false_hits").get<int>(), tests);
    const double misses = tests - row.at("hits").get<int>();
    EXPECT_DOUBLE_EQ(row.at("false_hit_pct"), 100.0 * row.at("false_hits").get<int>() / misses);
    EXPECT_LE(row.at("false_hit_pct_low"), row.at("false_hit_pct"));
    EXPECT_GT(row.at("false_hit_pct_high"), row.at("false_hit_pct"));
    EXPECT_LT(row.at("false_hit_pct_high").get<double>() - row.at("false_hit_pct_low").get<double>(), 25.0);
    if (row.at("ratio") == "zero") false_hits_at_zero += row.at("false_hits").get<std::uint64_t>();
  }
  EXPECT_EQ(rows[0].at("ratio"), "2^0");
  EXPECT_EQ(rows[0].at("boxes"), "aimed 2^-1");
  EXPECT_EQ(rows[1].at("boxes"), "anywhere 2^-1");
  EXPECT_EQ(rows.back().at("ratio"), "zero");
  EXPECT_EQ(rows.back().at("boxes"), "all");
  EXPECT_GT(false_hits_at_zero, 20U);
}

TEST(StiffnessCommand, CountsBoxTestsOfASceneAsCsv) {
  const Outcome outcome = run_hitpipe(stiffness({"--designs", "int_slabs", "--bits", "16/16", "--scene",
                                                 "spheres", "--rays", "20", "--format", "csv"}));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto lines = lines_of(outcome.out);
  ASSERT_EQ(lines.size(), 1 + ratios * (kinds + 1));
  EXPECT_EQ(lines[0],
            "design,bits,ratio,boxes,tests,hits,false_misses,false_hits,false_hit_pct,false_hit_pct_low,"
            "false_hit_pct_high,rays,reference_tests,extra_box_tests_pct,extra_box_tests_pct_low,"
            "extra_box_tests_pct_high,different_triangles");
  EXPECT_THAT(lines[ratios * kinds + 1], StartsWith("int_slabs,16/16,2^0,spheres,"));
  EXPECT_THAT(lines.back(),
              testing::MatchesRegex(
                  "int_slabs,16/16,zero,spheres,[0-9]+,,,,,,,20,[0-9]+,[0-9.]+,-?[0-9.]+,[0-9.]+,0"));
}

TEST(StiffnessCommand, WritesRowsAndPlots) {
  const sim::TemporaryFolder folder;
  const std::string out = (folder.path() / "out").string();
  const Outcome outcome =
      run_hitpipe(stiffness({"--scene", "spheres", "--rays", "20", "--format", "csv", "--out", out}));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(files_below(out),
            (std::vector<std::string>{"stiffness.csv", "stiffness.svg", "stiffness_scene.svg"}));
  EXPECT_EQ(contents_of(folder.path() / "out/stiffness.csv"), outcome.out);
  const std::string svg = contents_of(folder.path() / "out/stiffness.svg");
  EXPECT_THAT(svg, StartsWith("<?xml"));
  for (const char* const word :
       {"False hits on stiff rays, of the boxes that they miss", "int_slabs", "int_plucker", "24/24", "20/24",
        "16/16", "12/12", "zero", "ratio of direction components", "false hits, %"}) {
    EXPECT_THAT(svg, HasSubstr(word));
  }
  EXPECT_THAT(contents_of(folder.path() / "out/stiffness_scene.svg"),
              HasSubstr("Box tests of stiff rays on spheres, above robust float slabs"));
}

TEST(StiffnessCommand, SameSeedPrintsTheSameWhateverTheThreads) {
  const auto run = [](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"--designs", "int_slabs", "--bits", "12/12"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_hitpipe(stiffness(arguments)).out;
  };
  EXPECT_EQ(run({"--threads", "1"}), run({"--threads", "3"}));
  EXPECT_NE(run({"--seed", "1"}), run({"--seed", "2"}));
}

TEST(StiffnessCommand, FloatDesignIsMeasuredInItsOneFormat) {
  const auto lines = lines_of(run_hitpipe(stiffness({"--designs", "fp_slabs"})).out);
  ASSERT_EQ(lines.size(), 2 + 2 * ratios + 2);
  EXPECT_EQ(lines[1], "ratio   fp32");
}

/// Separated by commas or blanks, or the option repeated.
TEST(StiffnessCommand, TakesListsInEveryForm) {
  const auto lists = [](const std::vector<std::string>& how) {
    std::vector<std::string> arguments = how;
    arguments.insert(arguments.end(), {"--format", "csv"});
    const Outcome outcome = run_hitpipe(stiffness(arguments));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.out;
  };
  const std::string blanks = lists({"--designs", "int_slabs", "int_plucker", "--bits", "12/12", "16/16"});
  EXPECT_EQ(lines_of(blanks).size(), 1 + 4 * ratios * kinds);
  EXPECT_EQ(lists({"--designs", "int_slabs,int_plucker", "--bits", "12/12,16/16"}), blanks);
  EXPECT_EQ(
      lists({"--designs", "int_slabs", "--designs", "int_plucker", "--bits", "12/12", "--bits", "16/16"}),
      blanks);
}

TEST(StiffnessCommand, RunsAsManyTestsAsAsked) {
  const Outcome outcome = run_hitpipe(
      {"stiffness", "--tests", "20", "--designs", "int_slabs", "--bits", "12/12", "--format", "json"});
  std::uint64_t tests = 0;
  for (const json& row : json::parse(outcome.out)) tests += row.at("tests").get<std::uint64_t>();
  EXPECT_EQ(tests, 2 * 20 * ratios) << "of each kind, and of all together";
}

void expect_error(const std::vector<std::string>& more, const std::string& message) {
  const Outcome outcome = run_hitpipe(stiffness(more));
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err, "hitpipe: " + message + "\n");
}

TEST(StiffnessCommand, BadInputRejected) {
  expect_error({"--designs", "box"}, "design box: unknown; there are: " + rtl::design_names());
  expect_error(
      {"--bits", "5/6"},
      "bits 5/6: no format of int_slabs; allowed is n/t with n in 6..32 and t in 6..2n-1, for example 20/24");
  expect_error(
      {"--scene", "cone"},
      "scene \"cone\": no built-in scene and no file of that name; built-in are: " + ref::built_in_names());
  expect_error({"--bits", "6/6,7/7,8/8,9/9,10/10,11/11,12/12,13/13,14/14"},
               "--bits: 9 formats for int_slabs; allowed are 8 at most; see hitpipe stiffness --help");
  for (const char* const seed : {"-1", "18446744073709551616"}) {
    expect_error({"--seed", seed}, "--seed: Value " + std::string(seed) +
                                       " not in range 0 to 18446744073709551615; see hitpipe stiffness "
                                       "--help");
  }
  expect_error({"--rays", "0"}, "--rays: Value 0 not in range 1 to 1000000000; see hitpipe stiffness --help");
  expect_error({"--out", ""}, "--out: is empty; give the name of a folder; see hitpipe stiffness --help");
}

TEST(StiffnessCommand, MissingGnuplotRejected) {
  const sim::TemporaryFolder folder;
  const Outcome outcome = run_hitpipe(
      stiffness({"--designs", "int_slabs", "--bits", "12/12", "--out", (folder.path() / "out").string()}),
      {{"PATH", folder.path().string()}});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.err, "hitpipe: stiffness: gnuplot was not found; install the package gnuplot-nox\n");
}

}  // namespace
}  // namespace hitpipe::cli::stiffness_command_test
