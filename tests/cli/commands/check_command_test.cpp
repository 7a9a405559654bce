// `hitpipe check`: the lines for each category, the exit codes, and the replay of one case.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "rtl_gen/catalogue/design.hpp"
#include "sw_ref/judge/adversary/categories.hpp"
#include "tests/cli/program.hpp"

namespace hitpipe::cli::check_command_test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::StartsWith;

const std::string met = "origin 0 0 0 direction 1 0 0 length inf box 0.5 -0.5 -0.5 to 1 0.5 0.5";
const std::string passed = "origin 0 0 0 direction -1 0 0 length inf box 0.5 -0.5 -0.5 to 1 0.5 0.5";

Outcome check(std::vector<std::string> arguments, const Variables& variables = {}) {
  arguments.insert(arguments.begin(), "check");
  return run_hitpipe(arguments, variables);
}

/// Runs without a line on standard error and with exit code 0.
std::string printed(const std::vector<std::string>& arguments) {
  const Outcome outcome = check(arguments);
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
  return outcome.out;
}

void rejected(const std::vector<std::string>& arguments, const std::string& message) {
  const Outcome outcome = check(arguments);
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err, "hitpipe: " + message + "\n");
}

std::vector<std::string> keys_of(const std::string& text) {
  std::vector<std::string> keys;
  const auto rows = nlohmann::ordered_json::parse(text);
  for (const auto& [key, value] : rows.at(0).items()) keys.push_back(key);
  return keys;
}

TEST(CheckCommand, PrintsEveryCategoryAndTheSumInEightyColumns) {
  for (const char* const design : {"int_slabs", "int_plucker", "fp_slabs", "fp_plucker"}) {
    const Outcome outcome = check({design, "--tests", "20000"});
    EXPECT_EQ(outcome.exit_code, 0) << design;
    EXPECT_LE(widest_line(outcome.out), 80U) << design;
    const auto lines = lines_of(outcome.out);
    ASSERT_EQ(lines.size(), 2U + 27U + 1U + 2U) << design;
    for (std::size_t i = 0; i < 27; ++i) {
      EXPECT_THAT(lines[2 + i], StartsWith(std::string(ref::adversary::categories()[i].name) + " "));
    }
    EXPECT_THAT(lines[29], StartsWith("all "));
    EXPECT_THAT(lines[29], HasSubstr(" 20,000 "));
    EXPECT_THAT(lines[30], testing::MatchesRegex("false misses: [0-9.e-]+ % of the boxes met; "
                                                 "95 %: [0-9.e-]+ to [0-9.e-]+; [0-9]+ rays"));
    EXPECT_THAT(lines[31], StartsWith("false hits: "));
  }
}

TEST(CheckCommand, SaysWhichDesignFormatAndSeed) {
  EXPECT_THAT(printed({"int_slabs", "--tests", "2048", "--category", "face"}),
              StartsWith("int_slabs 20/24, seed 1\ncategory  tests   hits  false_misses  false_hits\nface "));
  EXPECT_THAT(
      printed({"int_plucker", "--bits", "12/12", "--tests", "2048", "--category", "face", "--seed", "7"}),
      StartsWith("int_plucker 12/12, seed 7\n"));
}

TEST(CheckCommand, FitsEightyColumnsWithTheMostTestsThatFinishHere) {
  const std::string text = printed({"int_slabs", "--tests", "1000000", "--category", "nearly_axis_parallel"});
  EXPECT_LE(widest_line(text), 80U) << text;
  EXPECT_THAT(text, HasSubstr(" 1,000,000 "));
}

TEST(CheckCommand, PrintsCsv) {
  const auto lines = lines_of(printed(
      {"int_slabs", "--tests", "4096", "--category", "edge", "--category", "stiff", "--format", "csv"}));
  ASSERT_EQ(lines.size(), 4U);
  EXPECT_EQ(lines[0],
            "category,tests,hits,false_misses,false_hits,false_miss_pct,false_miss_pct_low,"
            "false_miss_pct_high,false_hit_pct,false_hit_pct_low,false_hit_pct_high");
  EXPECT_THAT(lines[1], StartsWith("edge,2048,"));
  EXPECT_THAT(lines[2], StartsWith("stiff,2048,"));
  EXPECT_THAT(lines[3], StartsWith("all,4096,"));
}

TEST(CheckCommand, PrintsJsonWithTheRobustFormBesideFloatSlabs) {
  const std::vector<std::string> usual{"category",
                                       "tests",
                                       "hits",
                                       "false_misses",
                                       "false_hits",
                                       "false_miss_pct",
                                       "false_miss_pct_low",
                                       "false_miss_pct_high",
                                       "false_hit_pct",
                                       "false_hit_pct_low",
                                       "false_hit_pct_high"};
  const std::vector<std::string> how{"--tests", "2048", "--category", "corner", "--format", "json"};
  for (const char* const design : {"int_slabs", "int_plucker", "fp_plucker"}) {
    std::vector<std::string> arguments = how;
    arguments.insert(arguments.begin(), design);
    EXPECT_EQ(keys_of(check(arguments).out), usual) << design;
  }
  std::vector<std::string> arguments = how;
  arguments.insert(arguments.begin(), "fp_slabs");
  const Outcome outcome = check(arguments);
  std::vector<std::string> beside = usual;
  beside.insert(beside.end(), {"robust_misses", "robust_false_miss_pct", "robust_false_miss_pct_low",
                               "robust_false_miss_pct_high", "robust_false_hits"});
  EXPECT_EQ(keys_of(outcome.out), beside);
  const json row = json::parse(outcome.out).front();
  EXPECT_EQ(row.at("category"), "corner");
  EXPECT_DOUBLE_EQ(row.at("false_miss_pct"),
                   100.0 * row.at("false_misses").get<double>() / row.at("hits").get<double>());
  EXPECT_DOUBLE_EQ(row.at("false_hit_pct"),
                   100.0 * row.at("false_hits").get<double>() /
                       (row.at("tests").get<double>() - row.at("hits").get<double>()));
  EXPECT_LT(row.at("robust_misses"), row.at("false_misses"));
}

/// The boxes of a ray are neighbours and have much the same answer. An interval that takes them for
/// independent would be too narrow to hold what another seed gives.
TEST(CheckCommand, IntervalHoldsWhatOtherSeedsGive) {
  const auto all_of = [](const std::string& seed) {
    return json::parse(printed({"int_slabs", "--bits", "12/12", "--tests", "16384", "--category", "edge",
                                "--seed", seed, "--format", "json"}))
        .back();
  };
  const json wide = json::parse(printed({"int_slabs", "--bits", "12/12", "--tests", "1000000", "--category",
                                         "edge", "--seed", "99", "--format", "json"}))
                        .back();
  const double share = wide.at("false_hit_pct");
  int holds = 0;
  double width = 0;
  for (int seed = 1; seed <= 20; ++seed) {
    const json row = all_of(std::to_string(seed));
    holds += row.at("false_hit_pct_low") <= share && share <= row.at("false_hit_pct_high") ? 1 : 0;
    width += (row.at("false_hit_pct_high").get<double>() - row.at("false_hit_pct_low").get<double>()) / 20;
  }
  EXPECT_GE(holds, 17) << share << " +-" << width / 2;
}

TEST(CheckCommand, RunsAsManyTestsAsAsked) {
  for (const char* const tests : {"1", "28", "20000"}) {
    const json rows = json::parse(printed({"int_slabs", "--tests", tests, "--format", "json"}));
    EXPECT_EQ(rows.back().at("category"), "all");
    EXPECT_EQ(rows.back().at("tests").dump(), tests);
  }
}

TEST(CheckCommand, TakesCategoriesByCommasOrOneByOne) {
  const auto categories = [](const std::vector<std::string>& how) {
    std::vector<std::string> arguments = how;
    arguments.insert(arguments.end(), {"--tests", "10", "--format", "csv"});
    return printed(arguments);
  };
  const std::string one_by_one = categories({"int_slabs", "--category", "edge", "--category", "stiff"});
  EXPECT_EQ(lines_of(one_by_one).size(), 4U);
  EXPECT_EQ(categories({"int_slabs", "--category", "edge,stiff"}), one_by_one);
  // The design may come after the options; it is not taken for a category.
  EXPECT_EQ(categories({"--category", "edge,stiff", "int_slabs"}), one_by_one);
}

/// A float design proves nothing: its misses are counted and reported, and are not a failure.
TEST(CheckCommand, TellsTheFirstFalseMissAsACommandThatReplaysIt) {
  const Outcome outcome = check({"fp_slabs", "--tests", "2048", "--category", "corner"});
  EXPECT_EQ(outcome.exit_code, 0);
  const std::string start = " false misses; the first, simplified: hitpipe check fp_slabs --replay \"";
  const std::size_t at = outcome.err.find(start);
  ASSERT_NE(at, std::string::npos) << outcome.err;
  const std::string given = outcome.err.substr(at + start.size());
  ASSERT_TRUE(given.ends_with("\"\n"));
  const std::string text = printed({"fp_slabs", "--replay", given.substr(0, given.size() - 2)});
  EXPECT_THAT(text, StartsWith("design  fp_slabs\nbits    fp32\nexact   HIT\nunit    MISS\n"));
}

TEST(CheckCommand, ResultDependsOnTheSeedAndNotOnThreads) {
  const std::vector<std::string> one{"int_slabs", "--tests", "100000", "--seed", "5", "--threads", "1"};
  std::vector<std::string> more = one;
  more.back() = "64";
  EXPECT_EQ(printed(more), printed(one));
  std::vector<std::string> other = one;
  other[4] = "6";
  const std::string text = printed(other);
  EXPECT_NE(text.substr(text.find('\n')), printed(one).substr(text.find('\n')));
}

TEST(CheckCommand, LetsTheVerilogAnswerToo) {
  const auto lines = lines_of(printed(
      {"int_slabs", "--bits", "12/12", "--tests", "2048", "--category", "edge", "--rtl", "--format", "csv"}));
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_TRUE(lines[0].ends_with(",rtl_mismatches"));
  EXPECT_TRUE(lines[2].ends_with(",0"));
}

TEST(CheckCommand, WrongVerilogFails) {
  const sim::TemporaryFolder folder;
  const std::string verilator = always_missing_verilator(folder);
  const Variables variables{{"VERILATOR", verilator}};
  const Outcome run = check(
      {"int_slabs", "--bits", "12/12", "--tests", "2048", "--category", "edge", "--rtl", "--format", "json"},
      variables);
  EXPECT_EQ(run.exit_code, 1);
  const json row = json::parse(run.out).front();
  EXPECT_EQ(row.at("rtl_mismatches"), row.at("hits").get<int>() + row.at("false_hits").get<int>());
  EXPECT_EQ(run.err,
            "hitpipe: " + row.at("rtl_mismatches").dump() + " answers of the Verilog differ from the C++\n");
  const Outcome replay = check({"int_slabs", "--bits", "12/12", "--rtl", "--replay", met}, variables);
  EXPECT_EQ(replay.exit_code, 1);
  EXPECT_THAT(replay.out, HasSubstr("\nunit       HIT\nrtl        MISS\n"));
}

TEST(CheckReplay, PrintsTheAnswersAndEveryOperandInHexadecimal) {
  EXPECT_EQ(printed({"int_slabs", "--replay", met}),
            "design     int_slabs\nbits       20/24\nexact      HIT\nunit       HIT\n"
            "irx        0x00000\niry        0x00000\nirz        0x00000\nirlen      0x7fffff\n"
            "iri_floor  0x00000\niri_ceil   0x00001\nirj_floor  0x7ffff\nirj_ceil   0x7ffff\n"
            "irk_floor  0x7ffff\nirk_ceil   0x7ffff\nrinf       0x1\n"
            "ixmin      0x1ffff\nixmax      0x40000\niymin      0xe0000\niymax      0x20000\n"
            "izmin      0xe0000\nizmax      0x20000\n");
  const json object = json::parse(
      printed({"int_plucker", "--bits", "24/24", "--replay", passed, "--rtl", "--format", "json"}));
  EXPECT_EQ(object.at("exact"), "MISS");
  EXPECT_EQ(object.at("unit"), "MISS");
  EXPECT_EQ(object.at("rtl"), "MISS");
  EXPECT_EQ(object.at("iri"), "0x800001");
}

TEST(CheckReplay, OfACaseThatCannotBeReadRejected) {
  const std::string form =
      " is wanted; the form is: origin X Y Z direction X Y Z length L box X Y Z to X Y Z";
  rejected({"int_slabs", "--replay", "origin 0 0 0"}, "case: \"\" where \"direction\"" + form);
  rejected({"int_slabs", "--replay", "origin 0 0 x"}, "case: \"x\" where a number" + form);
  rejected({"int_slabs", "--replay", met + " 1"}, "case: \"1\" where the end" + form);
}

TEST(CheckReplay, OfACaseThatTheRefereeRefusesRejected) {
  rejected(
      {"int_slabs", "--replay", "origin 2 0 0 direction 1 0 0 length inf box 0.5 -0.5 -0.5 to 1 0.5 0.5"},
      "case: the ray is refused; its origin must lie in [-1, 1]^3, its direction be finite and not 0, "
      "its length >= 0 or inf");
  rejected(
      {"int_slabs", "--replay", "origin 0 0 0 direction 1 0 0 length inf box 0.5 -0.5 -0.5 to 0.25 0.5 0.5"},
      "case: the box is refused; it must lie in [-1, 1]^3 with min <= max on each axis");
}

TEST(CheckCommand, UnknownCategoryRejected) {
  std::string known;
  for (const auto& category : ref::adversary::categories()) {
    known += (known.empty() ? "" : ", ") + std::string(category.name);
  }
  rejected({"int_slabs", "--category", "corners"}, "category corners: unknown; there are: " + known);
}

TEST(CheckCommand, FormatsThatTheDesignDoesNotHaveRejected) {
  rejected(
      {"int_slabs", "--bits", "5/6"},
      "bits 5/6: no format of int_slabs; allowed is n/t with n in 6..32 and t in 6..2n-1, for example 20/24");
  rejected({"int_plucker", "--bits", "fp32"},
           "bits fp32: no format of int_plucker; allowed is n/t with n in 6..32 and t in 6..2n-1, for "
           "example 20/24");
  for (const char* const design : {"fp_slabs", "fp_plucker"}) {
    rejected({design, "--bits", "20/24"},
             "bits 20/24: no format of " + std::string(design) + "; allowed is fp32, which is e8m23");
  }
  EXPECT_EQ(check({"fp_slabs", "--bits", "fp32", "--tests", "2048", "--category", "edge"}).exit_code, 0);
}

TEST(CheckCommand, NumbersOutOfRangeRejected) {
  for (const char* const tests : {"0", "10000000000001"}) {
    rejected({"int_slabs", "--tests", tests}, "--tests: Value " + std::string(tests) +
                                                  " not in range 1 to 10000000000000; see hitpipe check "
                                                  "--help");
  }
  for (const char* const seed : {"-1", "1.5", "1e3", "0x10", "18446744073709551616", "one", ""}) {
    rejected({"int_slabs", "--seed", seed}, "--seed: Value " + std::string(seed) +
                                                " not in range 0 to 18446744073709551615; see hitpipe check "
                                                "--help");
  }
  rejected({"int_slabs", "--threads", "0"},
           "--threads: Value 0 not in range 1 to 1024; see hitpipe check --help");
  rejected({"int_slobs"}, "design int_slobs: unknown; there are: " + rtl::design_names());
}

/// The page for the user names what the program has.
TEST(CheckPage, ListsEveryCategory) {
  const std::string page = contents_of(std::filesystem::path(HITPIPE_SOURCE) / "docs" / "check.md");
  for (const auto& category : ref::adversary::categories()) {
    EXPECT_THAT(page, HasSubstr("\n| `" + std::string(category.name) + "` | ")) << category.name;
  }
  std::size_t rows = 0;
  for (const std::string& line : lines_of(page)) rows += line.starts_with("| `") ? 1 : 0;
  EXPECT_EQ(rows, ref::adversary::categories().size());
}

}  // namespace
}  // namespace hitpipe::cli::check_command_test
