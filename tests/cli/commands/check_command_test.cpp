// `hitpipe check`: the lines for each category, the exit codes, the replay of one case, and --stiff. What is
// counted is tested in tests/sim/check.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "rtl_gen/catalogue/design.hpp"
#include "sim/software/software.hpp"
#include "sw_ref/judge/adversary/categories.hpp"
#include "tests/cli/program.hpp"

namespace hitpipe::cli::check_command_test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::StartsWith;

const std::string met = "origin 0 0 0 direction 1 0 0 length inf box 0.5 -0.5 -0.5 to 1 0.5 0.5";
const std::string passed = "origin 0 0 0 direction -1 0 0 length inf box 0.5 -0.5 -0.5 to 1 0.5 0.5";

Outcome replayed(const std::vector<std::string>& words, const std::string& text,
                 const Variables& variables = {}) {
  return run_hitpipe(with(with({"check"}, words), {"--replay", text}), variables);
}

std::vector<std::string> keys_of(const std::string& text) {
  std::vector<std::string> keys;
  const auto rows = nlohmann::ordered_json::parse(text);
  for (const auto& [key, value] : rows.at(0).items()) keys.push_back(key);
  return keys;
}

TEST(CheckCommand, PrintsEveryCategoryAndTheSumInEightyColumns) {
  for (const std::string design : {"int_slabs", "fp_slabs"}) {
    const Outcome outcome = hitpipe("check " + design + " --tests 20000 --seed 7");
    EXPECT_EQ(outcome.exit_code, 0) << design;
    EXPECT_LE(widest_line(outcome.out), 80U) << design;
    const auto lines = lines_of(outcome.out);
    ASSERT_EQ(lines.size(), 2U + 27U + 1U + 2U) << design;
    EXPECT_THAT(lines[0], testing::MatchesRegex(design + " [^ ]+, seed 7"));
    for (std::size_t i = 0; i < 27; ++i)
      EXPECT_THAT(lines[2 + i], StartsWith(std::string(ref::adversary::categories()[i].name) + " "));
    EXPECT_THAT(lines[29], StartsWith("all "));
    EXPECT_THAT(lines[29], HasSubstr(" 20,000 "));
    EXPECT_THAT(lines[30], testing::MatchesRegex("false misses: [0-9.e-]+ % of the boxes met; "
                                                 "95 %: [0-9.e-]+ to [0-9.e-]+; [0-9]+ rays"));
    EXPECT_THAT(lines[31], StartsWith("false hits: "));
  }
}

/// Categories by commas or one by one; the design may come after them.
TEST(CheckCommand, PrintsCsvOfSomeCategories) {
  const std::string csv =
      printed("check int_slabs --tests 4096 --category edge --category stiff --format csv");
  const auto lines = lines_of(csv);
  ASSERT_EQ(lines.size(), 3U) << "sums are not among the categories";
  EXPECT_EQ(
      lines[0],
      "design,bits,seed,category,tests,exact_hits,false_misses,false_hits,false_miss_pct,false_miss_pct_low,"
      "false_miss_pct_high,false_hit_pct,false_hit_pct_low,false_hit_pct_high");
  EXPECT_THAT(lines[1], StartsWith("int_slabs,n20/24,1,edge,2048,"));
  EXPECT_THAT(lines[2], StartsWith("int_slabs,n20/24,1,stiff,2048,"));
  EXPECT_EQ(printed("check --category edge,stiff int_slabs --tests 4096 --threads 5 --format csv"), csv);
  EXPECT_NE(printed("check --category edge,stiff int_slabs --tests 4096 --seed 2 --format csv"), csv);
}

TEST(CheckCommand, PrintsJsonWithTheRobustFormBesideFloatSlabs) {
  const std::string how = " --tests 2048 --category corner --format json";
  const std::vector<std::string> usual = keys_of(hitpipe("check int_slabs" + how).out);
  EXPECT_EQ(usual.size(), 14U);
  const Outcome outcome = hitpipe("check fp_slabs" + how);
  std::vector<std::string> beside = usual;
  beside.insert(beside.end(), {"ize_misses", "ize_false_miss_pct", "ize_false_miss_pct_low",
                               "ize_false_miss_pct_high", "ize_false_hits"});
  EXPECT_EQ(keys_of(outcome.out), beside);
  const json row = json::parse(outcome.out).front();
  const auto number = [&](const char* key) { return row.at(key).get<double>(); };
  EXPECT_EQ(row.at("category"), "corner");
  EXPECT_DOUBLE_EQ(number("false_miss_pct"), 100.0 * number("false_misses") / number("exact_hits"));
  EXPECT_DOUBLE_EQ(number("false_hit_pct"),
                   100.0 * number("false_hits") / (number("tests") - number("exact_hits")));
  EXPECT_LT(number("ize_misses"), number("false_misses"));
}

/// The boxes of a ray are neighbours and have much the same answer. An interval that takes them for
/// independent would be too narrow to hold what another seed gives.
TEST(CheckCommand, IntervalHoldsWhatOtherSeedsGive) {
  const auto all_of = [](int tests, int seed) {
    const std::string words =
        "check int_slabs --bits 12/12 --tests {} --category edge --seed {} --format json";
    return json::parse(printed(fmt::format(fmt::runtime(words), tests, seed))).back();
  };
  const double share = all_of(1'000'000, 99).at("false_hit_pct");
  int holds = 0;
  for (int seed = 1; seed <= 20; ++seed) {
    const json row = all_of(16'384, seed);
    holds += row.at("false_hit_pct_low") <= share && share <= row.at("false_hit_pct_high") ? 1 : 0;
  }
  EXPECT_GE(holds, 17) << share;
}

/// A float design proves nothing: its misses are counted and reported, and are not a failure.
TEST(CheckCommand, TellsTheFirstFalseMissAsACommandThatReplaysIt) {
  const Outcome outcome = hitpipe("check fp_slabs --tests 2048 --category corner");
  EXPECT_EQ(outcome.exit_code, 0);
  const std::string start = " false misses; the first, simplified: hitpipe check fp_slabs --replay \"";
  const std::size_t at = outcome.err.find(start);
  ASSERT_NE(at, std::string::npos) << outcome.err;
  const std::string given = outcome.err.substr(at + start.size());
  ASSERT_TRUE(given.ends_with("\"\n"));
  EXPECT_THAT(replayed({"fp_slabs"}, given.substr(0, given.size() - 2)).out,
              StartsWith("design  fp_slabs\nbits    fp32\nexact   HIT\nunit    MISS\n"));
}

TEST(CheckCommand, LetsTheVerilogAnswerToo) {
  const std::string words = "check int_slabs --bits 12/12 --tests 2048 --category edge --rtl --format ";
  const auto lines = lines_of(printed(words + "csv"));
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_TRUE(lines[0].ends_with(",rtl_mismatches"));
  EXPECT_TRUE(lines[1].ends_with(",0"));

  const sim::TemporaryFolder folder;
  const Variables wrong{{"VERILATOR", always_missing_verilator(folder)}};
  const Outcome run = hitpipe(words + "json", wrong);
  EXPECT_EQ(run.exit_code, 1);
  const json row = json::parse(run.out).front();
  EXPECT_EQ(row.at("rtl_mismatches"), row.at("exact_hits").get<int>() + row.at("false_hits").get<int>());
  EXPECT_EQ(run.err, "hitpipe: int_slabs 12/12: " + row.at("rtl_mismatches").dump() +
                         " answers of the Verilog differ from the C++\n");
  const Outcome replay = replayed({"int_slabs", "--bits", "12/12", "--rtl"}, met, wrong);
  EXPECT_EQ(replay.exit_code, 1);
  EXPECT_THAT(replay.out, HasSubstr("\nunit       HIT\nrtl        MISS\n"));
}

/// Of a unit that says ties or crossings, with Verilog that does not settle an edge of a tie as the C++ does.
TEST(CheckCommand, CountsTiesOfATriangleUnitAndFindsAFaultyRule) {
  const std::string start = "check int_triangle --tests 2800 --rtl --format json --bits ";
  const auto all_of = [](const std::string& text) { return json::parse(text).back(); };
  EXPECT_FALSE(all_of(printed(start + "8+0s8")).contains("ties"));
  for (const auto& [bits, line] : {std::pair{"8+0s8c1", "assign tie = "}, {"8+0s8c2", "wire ok_v = "}}) {
    const Outcome right = hitpipe(start + bits);
    EXPECT_EQ(right.exit_code, 0) << right.err;
    const json row = all_of(right.out);
    EXPECT_GT(row.at("ties").get<int>(), 500);
    EXPECT_GT(row.at("counted").get<int>(), 100);
    EXPECT_LT(row.at("counted").get<int>(), row.at("ties").get<int>());
    EXPECT_EQ(row.at("rtl_mismatches"), 0);

    const sim::TemporaryFolder folder;
    const std::string sed = fmt::format("s/{}/&1 ^ /", line);
    const Outcome wrong = hitpipe(start + bits, {{"VERILATOR", damaging_verilator(folder, sed)}});
    EXPECT_EQ(wrong.exit_code, 1);
    EXPECT_GT(all_of(wrong.out).at("rtl_mismatches").get<int>(), 50) << bits;
  }
}

TEST(CheckReplay, PrintsTheAnswersAndEveryOperandInHexadecimal) {
  EXPECT_EQ(replayed({"int_slabs"}, met).out,
            "design     int_slabs\nbits       20/24\nexact      HIT\nunit       HIT\n"
            "irx        0x00000\niry        0x00000\nirz        0x00000\nirlen      0x7fffff\n"
            "iri_floor  0x00000\niri_ceil   0x00001\nirj_floor  0x7ffff\nirj_ceil   0x7ffff\n"
            "irk_floor  0x7ffff\nirk_ceil   0x7ffff\nrinf       0x1\n"
            "ixmin      0x1ffff\nixmax      0x40000\niymin      0xe0000\niymax      0x20000\n"
            "izmin      0xe0000\nizmax      0x20000\n");
  const json object =
      json::parse(replayed({"int_plucker", "--bits", "24/24", "--rtl", "--format", "json"}, passed).out);
  for (const char* const judge : {"exact", "unit", "rtl"}) EXPECT_EQ(object.at(judge), "MISS");
  EXPECT_EQ(object.at("iri"), "0x800001");
}

TEST(CheckReplay, CasesThatCannotBeUsedRejected) {
  const std::string form =
      " is wanted; the form is: origin X Y Z direction X Y Z length L box X Y Z to X Y Z";
  const std::string box = " length inf box 0.5 -0.5 -0.5 to ";
  const std::pair<std::string, std::string> cases[] = {
      {"origin 0 0 0", "\"\" where \"direction\"" + form},
      {"origin 0 0 x", "\"x\" where a number" + form},
      {met + " 1", "\"1\" where the end" + form},
      {"origin 2 0 0 direction 1 0 0" + box + "1 0.5 0.5",
       "the ray is refused; its origin must lie in [-1, 1]^3, its direction be finite and not 0, its length "
       ">= 0 or "
       "inf"},
      {"origin 0 0 0 direction 1 0 0" + box + "0.25 0.5 0.5",
       "the box is refused; it must lie in [-1, 1]^3 with min <= max on each axis"}};
  for (const auto& [text, message] : cases) {
    const Outcome outcome = replayed({"int_slabs"}, text);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.err, "hitpipe: case: " + message + "\n");
  }
  std::string known;
  for (const auto& category : ref::adversary::categories())
    known += (known.empty() ? "" : ", ") + std::string(category.name);
  EXPECT_EQ(hitpipe("check int_slabs --category corners").err,
            "hitpipe: category corners: unknown; there are: " + known + "\n");
}

/// The page for the user names what the program has.
TEST(CheckPage, ListsEveryCategory) {
  std::string page = contents_of(std::filesystem::path(HITPIPE_SOURCE) / "docs" / "check.md");
  page.erase(0, page.find("\n## Categories\n"));
  page.erase(page.find("\n## ", 1));
  for (const auto& category : ref::adversary::categories())
    EXPECT_THAT(page, HasSubstr("\n| `" + std::string(category.name) + "` | ")) << category.name;
  std::size_t rows = 0;
  for (const std::string& line : lines_of(page)) rows += line.starts_with("| `") ? 1 : 0;
  EXPECT_EQ(rows, ref::adversary::categories().size());
}

/// A line for each category of each design of the catalogue that never misses, and one for their sum.
TEST(CheckSafe, JudgesAllDesignsThatNeverMissInOneTable) {
  const std::string how = "check --safe --tests 20000";
  const Outcome text = hitpipe(how);
  EXPECT_EQ(text.exit_code, 0) << text.err;
  EXPECT_LE(widest_line(text.out), 80U);
  const auto lines = lines_of(text.out);
  std::string alone;
  EXPECT_EQ(lines.at(0), "seed 1, 20000 tests of each unit");
  EXPECT_THAT(lines.at(1), StartsWith("misses "));
  EXPECT_THAT(lines.at(2), StartsWith("false hits, % "));
  EXPECT_THAT(lines.at(3), testing::ContainsRegex("misses  95 % of met +false hits, %"));
  std::size_t at = 4;
  for (const rtl::Design& design : rtl::designs()) {
    if (!design.kind.of_boxes || !design.conservative) continue;
    EXPECT_THAT(lines.at(at), StartsWith(std::string(design.name) + " "));
    EXPECT_THAT(lines.at(at + 1), StartsWith(to_string(design.default_format) + " "));
    for (const auto& category : ref::adversary::categories())
      EXPECT_THAT(lines.at(at++), HasSubstr(" " + std::string(category.name) + " "));
    at += sim::software_of(design).categories.size();
    EXPECT_THAT(lines.at(at++), HasSubstr(" all "));
    const std::string csv =
        printed("check " + std::string(design.name) + " --tests 20000 --threads 1 --format csv");
    alone += alone.empty() ? csv : csv.substr(csv.find('\n') + 1);
  }
  EXPECT_EQ(lines.size(), at);
  EXPECT_EQ(printed(how + " --format csv"), alone);
}

TEST(CheckUnits, AreDesignsAndFormatsInOneTable) {
  const std::string how = " --tests 4096 --category edge,stiff --format ";
  const Outcome csv = hitpipe("check int_slabs,fp_slabs --bits 12/12,20/24" + how + "csv");
  EXPECT_EQ(csv.exit_code, 0) << "fp_slabs may miss";
  EXPECT_THAT(csv.err, HasSubstr(": hitpipe check fp_slabs --replay "));
  const auto lines = lines_of(csv.out);
  ASSERT_EQ(lines.size(), 7U);
  EXPECT_EQ(lines[0] + "\n" + lines[3] + "\n" + lines[4] + "\n",
            printed("check int_slabs --bits 20/24" + how + "csv"));
  EXPECT_THAT(lines[5], StartsWith("fp_slabs,fp32,1,edge,2048,"));
  const json rows = json::parse(printed("check int_slabs --bits 12/12,20/24" + how + "json"));
  ASSERT_EQ(rows.size(), 6U);
  EXPECT_EQ(rows[5].at("category"), "all");
  EXPECT_EQ(rows[5].at("tests"), 4096);
}

TEST(CheckUnits, AreJoinedFromPieces) {
  const sim::TemporaryFolder folder;
  const std::string how = "check int_slabs int_major --tests 20000";
  std::string files;
  for (const std::string piece : {"1", "2", "3"}) {
    const std::string file = (folder.path() / (piece + ".json")).string();
    static_cast<void>(printed(how + " --piece " + piece + "/3 --out " + file));
    files += " " + file;
  }
  EXPECT_EQ(printed("check --join" + files + " --format json"), printed(how + " --format json"));
}

TEST(CheckUnits, FailWhereOneOfThemFails) {
  const sim::TemporaryFolder folder;
  const Outcome run = hitpipe("check int_slabs,int_plucker --bits 12/12 --tests 2048 --category edge --rtl",
                              {{"VERILATOR", always_missing_verilator(folder)}});
  EXPECT_EQ(run.exit_code, 1);
  const auto wrong = lines_of(run.err);
  ASSERT_EQ(wrong.size(), 2U) << run.err;
  EXPECT_THAT(wrong[0], StartsWith("hitpipe: int_slabs 12/12: "));
  EXPECT_THAT(wrong[1], StartsWith("hitpipe: int_plucker 12/12: "));
}

constexpr std::size_t ratios = 22;
constexpr std::size_t kinds = 6;  // of boxes

TEST(CheckStiff, PrintsATableForEachDesignThatNeverMisses) {
  const std::string text = printed("check --stiff --tests 60");
  EXPECT_LE(widest_line(text), 80U);
  const auto lines = lines_of(text);
  std::size_t at = 0;
  for (const rtl::Design& design : rtl::designs()) {
    if (!design.conservative || !sim::why_not_traced(design).empty()) continue;
    ASSERT_LT(at + 2 * ratios + 2, lines.size()) << design.name;
    EXPECT_EQ(lines[at], std::string(design.name) + ": false hits, % of the boxes that the ray misses");
    std::string head = "ratio  ";
    for (const Format& format : sim::stiffness_formats(design))
      head += fmt::format(" {:<8}", to_string(format));
    EXPECT_EQ(lines[at + 1], head.erase(head.find_last_not_of(' ') + 1));
    EXPECT_THAT(lines[at + 2], StartsWith("2^0 "));
    EXPECT_THAT(lines[at + 3], StartsWith("+-95 % "));
    EXPECT_THAT(lines[at + 44], StartsWith("zero "));
    at += 2 * ratios + 3;
  }
  ASSERT_EQ(lines.size(), at + 1);
  EXPECT_EQ(lines.back(), "60 tests a ratio; +-95 %: half the width of the 95 % interval");
}

/// Designs and formats by commas, blanks or one by one.
TEST(CheckStiff, PrintsEveryKindOfBoxOfTheDesignsNamed) {
  const std::string csv =
      printed("check --stiff int_slabs int_plucker --bits 12/12,16/16 --tests 600 --format csv");
  EXPECT_EQ(lines_of(csv).size(), 1 + 4 * ratios * kinds);
  EXPECT_EQ(printed("check int_slabs,int_plucker --bits 12/12 --bits 16/16 --tests 600 --threads 3 --stiff "
                    "--format csv"),
            csv);
  EXPECT_NE(
      printed("check --stiff int_slabs,int_plucker --bits 12/12,16/16 --tests 600 --seed 2 --format csv"),
      csv);
  const json rows = json::parse(printed("check --stiff int_slabs --bits 16/16 --tests 600 --format json"));
  ASSERT_EQ(rows.size(), ratios * kinds);
  std::uint64_t false_hits_at_zero = 0;
  for (const json& row : rows) {
    const int tests = 100;
    EXPECT_EQ(row.at("tests"), tests);
    EXPECT_EQ(row.at("false_misses"), 0);
    const double misses = tests - row.at("exact_hits").get<int>();
    EXPECT_DOUBLE_EQ(row.at("false_hit_pct"), 100.0 * row.at("false_hits").get<int>() / misses);
    EXPECT_LE(row.at("false_hit_pct_low"), row.at("false_hit_pct"));
    EXPECT_GT(row.at("false_hit_pct_high"), row.at("false_hit_pct"));
    if (row.at("log2_ratio") == "inf") false_hits_at_zero += row.at("false_hits").get<std::uint64_t>();
  }
  EXPECT_GT(false_hits_at_zero, 20U);
  EXPECT_LE(widest_line(
                printed("check --stiff int_slabs --tests 60 --bits 24/24,24/28,24/32,20/20,20/24,20/28,16/16,"
                        "12/12")),
            80U);
  EXPECT_EQ(lines_of(printed("check --stiff fp_slabs --tests 60")).at(1), "ratio   fp32");
}

TEST(CheckStiff, CountsBoxTestsOfASceneAndWritesRowsAndPlots) {
  const sim::TemporaryFolder folder;
  const std::string out = (folder.path() / "out").string();
  const std::string csv = printed(
      "check --stiff int_slabs --bits 16/16 --tests 60 --scene spheres --rays 20 --format csv --out " + out);
  const auto lines = lines_of(csv);
  ASSERT_EQ(lines.size(), 1 + ratios * (kinds + 1));
  EXPECT_EQ(
      lines[0],
      "design,bits,log2_ratio,boxes,tests,exact_hits,false_misses,false_hits,false_hit_pct,false_hit_pct_low,"
      "false_hit_pct_high,rays,reference_tests,extra_box_tests_pct,extra_box_tests_pct_low,"
      "extra_box_tests_pct_high,different_triangles");
  EXPECT_THAT(lines.back(),
              testing::MatchesRegex(
                  "int_slabs,n16/16,inf,spheres,[0-9]+,,,,,,,20,[0-9]+,[0-9.]+,-?[0-9.]+,[0-9.]+,0"));
  EXPECT_EQ(files_below(out),
            (std::vector<std::string>{"stiffness.csv", "stiffness.csv-metadata.json", "stiffness.pdf",
                                      "stiffness.png", "stiffness.svg", "stiffness_scene.pdf",
                                      "stiffness_scene.png", "stiffness_scene.svg"}));
  EXPECT_EQ(contents_of(out + "/stiffness.csv"), csv);
  for (const char* const word : {"<?xml", "width=\"272.", "int_slabs", "16/16", "zero",
                                 "ratio of direction components", ">false hits of "})
    EXPECT_THAT(contents_of(out + "/stiffness.svg"), HasSubstr(word));
  EXPECT_THAT(contents_of(out + "/stiffness_scene.svg"), HasSubstr(">box tests above conservative "));
  EXPECT_THAT(contents_of(out + "/stiffness_scene.svg"),
              HasSubstr("<dc:title>Box tests of stiff rays on spheres</dc:title>"));
  const std::string svg = contents_of(out + "/stiffness.svg");
  printed("check --stiff int_slabs --bits 16/16 --tests 60 --scene spheres --rays 20 --out " + out);
  EXPECT_EQ(contents_of(out + "/stiffness.svg"), svg);
}

TEST(CheckStiff, PlotsForAPaperHaveItsWidth) {
  const sim::TemporaryFolder folder;
  const std::string out = (folder.path() / "out").string();
  const auto drawn = [&](const std::string& width) {
    printed("check --stiff int_slabs --bits 16/16 --tests 60 --plot-width " + width + " --out " + out);
    return contents_of(out + "/stiffness.svg");
  };
  EXPECT_THAT(drawn("84mm"),
              testing::AllOf(HasSubstr("<svg "), HasSubstr(" width=\"238.1102"), HasSubstr("font: 8px ")));
  EXPECT_THAT(contents_of(out + "/stiffness.pdf"), HasSubstr("/MediaBox [ 0 0 238.1102"));
  EXPECT_THAT(drawn("3.5in"), HasSubstr(" width=\"252pt\""));
  EXPECT_THAT(drawn("240pt"), HasSubstr(" width=\"240pt\""));
  EXPECT_THAT(drawn("40mm"), HasSubstr(" width=\"113.3858"));
  EXPECT_THAT(drawn("400mm"), HasSubstr(" width=\"1133.858"));
}

TEST(CheckStiff, WrongPlotWidthRejected) {
  for (const std::string width :
       {"84", "mm", "8.4cm", "39.9mm", "401mm", "-84mm", "nanmm", "1e9mm", "84 mm"}) {
    const Outcome outcome =
        run_hitpipe({"check", "--stiff", "int_slabs", "--out", "none", "--plot-width", width});
    EXPECT_EQ(outcome.exit_code, 2) << width;
    EXPECT_EQ(
        outcome.err,
        "hitpipe: --plot-width: " + width +
            " is no width from 40mm to 400mm, such as 84mm, 3.3in or 240pt; see hitpipe check --help\n");
  }
  EXPECT_EQ(hitpipe("check --stiff int_slabs --plot-width 84mm").err,
            "hitpipe: --plot-width requires --out; see hitpipe check --help\n");
}

}  // namespace
}  // namespace hitpipe::cli::check_command_test
