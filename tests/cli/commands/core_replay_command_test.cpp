// `hitpipe core replay`: recorded answers are judged through an image. The mesh is that of replay_test, in units of the
// grid, so that the distances of the hits are known.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/program.hpp"

namespace hitpipe::cli::replay_command_test {
namespace {

using testing::HasSubstr;

constexpr const char* mesh =
    "v -100 -100 0\nv 100 -100 0\nv 100 100 3\nv -100 0 37\nv -100 -120 0\nv 100 -120 1\nv 100 120 1\n"
    "v -300 -300 -200\nv 300 -300 -200\nv 0 300 -200\n"
    "f 2 2 3\nf 1 2 3\nf 1 3 4\nf 5 6 7\nf 8 9 10\n";

/// 0: triangles 1 and 2 at 498.5. 1: triangle 1 at 499.4, and 3 at 499.25. 2: none. 3: triangle 4 at 700. 4: as 1.
constexpr const char* rays =
    "ox,oy,oz,dx,dy,dz,any\n0,0,500,0,0,-1,0\n50,-60,500,0,0,-1,0\n0,600,500,0,0,-1,0\n"
    "-20,-250,500,0,0,-3,0\n50,-60,500,0,0,-1,1\n";

/// Row by row, what is right.
const std::vector<std::string> right{"1,1,498,", "1,1,499,", "0,,,", "1,4,700,", "1,3,499,"};

class ReplayCommand : public testing::Test {
 protected:
  void SetUp() override {
    folder_.write("mesh.obj", mesh);
    folder_.write("rays.csv", rays);
    printed("core image --scene " + file("mesh.obj") + placing_ + " --cube 0,0,0,1023 --bits 12+0s12 --out " +
            file("mesh.bin"));
  }
  [[nodiscard]] std::string file(const std::string& name) const { return (folder_.path() / name).string(); }
  [[nodiscard]] std::string words(const std::string& answers) const {
    return "core replay " + file("mesh.bin") + " --bits 12+0s12 --rays " + file("rays.csv") + " --answers " +
           file(answers);
  }
  /// Of the right answers, where row `changed` is another.
  [[nodiscard]] Outcome replayed(std::size_t changed, const std::string& row,
                                 const std::string& more = "") const {
    std::string text = "hit,number,t,failed\n";
    for (std::size_t i = 0; i < right.size(); ++i) text += (i == changed ? row : right[i]) + "\n";
    folder_.write("answers.csv", text);
    return hitpipe(words("answers.csv") + more);
  }
  void refused(const std::string& words, const std::string& message) const {
    const Outcome outcome = hitpipe(words);
    EXPECT_EQ(outcome.exit_code, 2) << words;
    EXPECT_EQ(outcome.out, "") << words;
    EXPECT_EQ(outcome.err, "hitpipe: " + message + "\n");
  }

  const std::string placing_ = " --eye 0,0,900 --target 0,0,0 --light 0,0,900";
  const sim::TemporaryFolder folder_;
};

TEST_F(ReplayCommand, FindsTheAnswersOfACoreRight) {
  const std::string traced = "core trace --native --rays-in-flight 2,8 --image " + file("mesh.bin") +
                             placing_ + " --bits 12+0s12 --rays " + file("rays.csv") + " --answers " +
                             file("core.csv");
  printed(traced);
  EXPECT_EQ(printed(words("core.csv")),
            "verdict    answers  reason\n"
            "same            10\n"
            "exact tie        0\n"
            "near tie         0\n"
            "nearer           0\n"
            "farther          0\n");
}

TEST_F(ReplayCommand, HasAVerdictForEachAnswer) {
  struct Case {
    std::size_t ray;
    std::string row, verdict, reason;
  };
  const std::vector<Case> cases{
      {0, "1,1,498,", "same", ""},
      {0, "1,2,498,", "exact tie", ""},
      {1, "1,3,499,", "near tie", ""},
      {1, "1,1,498,", "nearer", ""},
      {2, "1,1,499,", "nearer", ""},
      {1, "1,4,700,", "farther", ""},
      {3, "0,,,", "farther", ""},
      {2, ",,,1", "failed", "it is no ray"},
      {3, ",,,", "failed", "the record does not say why"},
      {1, "1,5,499,", "failed", "the image has no triangle of that number"},
      {4, "1,0,,", "failed", "the image has no triangle of that number"},
      {4, "1,2,499,", "failed", "the ray does not meet its triangle"},
      {1, "1,4,499,", "failed", "its triangle has another T"},
  };
  for (const auto& [ray, row, verdict, reason] : cases) {
    const Outcome outcome = replayed(ray, row, " --format json");
    const bool good = verdict == "same" || verdict == "exact tie";
    EXPECT_EQ(outcome.exit_code, good ? 0 : 1) << row << outcome.err;
    EXPECT_EQ(outcome.err, "");
    const auto told = nlohmann::json::parse(outcome.out);
    for (const auto& each : told.at("verdicts")) {
      const bool of_others = each.at("verdict") == "same";
      const bool named = each.at("verdict") == verdict;
      EXPECT_EQ(each.at("answers"), (of_others ? 4 : 0) + (named ? 1 : 0)) << row << each;
      if (named) {
        EXPECT_EQ(each.at("reason"), reason) << row;
      }
    }
    EXPECT_EQ(told.at("verdicts").size(), verdict == "failed" ? 6U : 5U) << row;
    const auto& bad = told.at("bad_answers");
    ASSERT_EQ(bad.size(), good ? 0U : 1U) << row;
    if (good) continue;
    EXPECT_EQ(bad.at(0).at("ray"), ray) << row;
    EXPECT_EQ(bad.at(0).at("verdict"), verdict) << row;
    EXPECT_EQ(bad.at(0).at("reason"), reason) << row;
  }
}

TEST_F(ReplayCommand, PrintsTheFirstBadAnswers) {
  const Outcome one = replayed(1, "1,4,700,");
  EXPECT_THAT(one.out, HasSubstr("farther          1\n\n"
                                 "1 of 1 bad answers:\n"
                                 "ray  verdict  number    t  right_number  right_t\n"
                                 "  1  farther       4  700             1      499\n"));
  std::string asked = "ox,oy,oz,dx,dy,dz\n", failed = "hit,number,t,failed\n";
  for (int i = 0; i < 12; ++i) {
    asked += "50,-60,500,0,0,-1\n";
    failed += ",,," + std::to_string(1 + i % 5) + "\n";
  }
  folder_.write("rays.csv", asked);
  folder_.write("failed.csv", failed);
  const Outcome many = hitpipe(words("failed.csv"));
  EXPECT_EQ(many.exit_code, 1);
  EXPECT_THAT(many.out, HasSubstr("\n10 of 12 bad answers:\n"));
  EXPECT_THAT(many.out, HasSubstr("failed           3  it is no ray\n"));
  EXPECT_EQ(lines_of(many.out).size(), 11U + 1 + 1 + 11);
  EXPECT_LE(widest_line(many.out), 80U);
  EXPECT_THAT(hitpipe(words("failed.csv") + " --format csv").out, HasSubstr("\nfailed,3,it is no ray\n"));
}

TEST_F(ReplayCommand, RefusesFilesThatAreNone) {
  folder_.write("short.csv", "hit,number,t\n0,,\n");
  refused(words("short.csv"), file("short.csv") + ": ray 1 has no answer; each of the 5 rays of " +
                                  file("rays.csv") + " needs one");
  folder_.write("word.csv", "hit,number,t\n1,one,2\n");
  refused(words("word.csv"),
          file("word.csv") + ": line 2: number is \"one\"; allowed is a whole number from 0 to 4294967294");
  refused(words("none.csv"), file("none.csv") + ": cannot read the file: No such file or directory");
  EXPECT_THAT(hitpipe(words("rays.csv")).err,
              HasSubstr("rays.csv: line 1: column \"ox\" is not known; the first "
                        "line must name the columns hit,number,t[,ray,"));
  const std::string begin =
      "core replay " + file("mesh.bin") + " --answers " + file("short.csv") + " --rays ";
  refused(begin + file("rays.csv") + " --bits 16+1s16",
          "--bits 16+1s16: the image has a grid of 12 bits; allowed are formats that begin with 12+");
  folder_.write("far.csv", "ox,oy,oz,dx,dy,dz\n0,0,5000,0,0,-1\n");
  refused(begin + file("far.csv"),
          file("far.csv") + ": line 2: oz 5000 lies outside the cube; a chosen cube must hold all origins");
  std::string bytes = contents_of(file("mesh.bin"));
  bytes.at(170) ^= 1;
  folder_.write("mesh.bin", bytes);
  refused(words("short.csv"),
          file("mesh.bin") + ": the checksum differs: the image was changed or half written");
}

}  // namespace
}  // namespace hitpipe::cli::replay_command_test
