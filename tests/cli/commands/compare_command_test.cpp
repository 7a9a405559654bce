// `hitpipe compare`: the difference of two images, and the message for files that are not images.
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/program.hpp"

namespace hitpipe::cli::compare_command_test {
namespace {

class CompareCommand : public testing::Test {
 protected:
  [[nodiscard]] std::string file(const std::string& name) const { return (folder_.path() / name).string(); }
  [[nodiscard]] std::string rendered(const std::string& name, const std::string& light) const {
    const Outcome outcome = run_hitpipe({"render", "--scene", "spheres", "--width", "24", "--height", "16",
                                         "--light", light, "--out", file(name)});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return file(name);
  }
  /// One line of error and nothing else.
  static void rejected(const std::vector<std::string>& arguments, const std::string& message) {
    const Outcome outcome = run_hitpipe(arguments);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(outcome.err, "hitpipe: " + message + "\n");
  }

  sim::TemporaryFolder folder_;
};

TEST_F(CompareCommand, SaysHowFarImagesAreApart) {
  const std::string a = rendered("a.png", "0,50,0");
  const std::string b = rendered("b.png", "50,0,0");
  const Outcome equal = run_hitpipe({"compare", a, a, "--format", "json"});
  EXPECT_EQ(equal.exit_code, 0);
  const auto same = nlohmann::json::parse(equal.out);
  EXPECT_EQ(same.at("width"), 24);
  EXPECT_EQ(same.at("height"), 16);
  EXPECT_EQ(same.at("channels"), 3);
  EXPECT_EQ(same.at("pixels"), 384);
  EXPECT_EQ(same.at("different_pixels"), 0);
  EXPECT_EQ(same.at("largest_difference"), 0.0);
  EXPECT_TRUE(same.at("psnr_db").is_null());  // infinite
  EXPECT_THAT(run_hitpipe({"compare", a, a}).out, testing::HasSubstr("\npsnr_db             inf\n"));

  const Outcome outcome = run_hitpipe({"compare", a, b, "--out", file("d.png"), "--format", "json"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(outcome.err, "");
  const auto apart = nlohmann::json::parse(outcome.out);
  EXPECT_GT(apart.at("different_pixels"), 20);
  EXPECT_GT(apart.at("largest_difference"), 0.1);
  EXPECT_GT(apart.at("mean_difference"), 0.0);
  EXPECT_GT(apart.at("psnr_db"), 5.0);
  EXPECT_EQ(apart.at("difference_image"), file("d.png"));
  EXPECT_THAT(contents_of(file("d.png")), testing::StartsWith("\x89PNG"));
  EXPECT_EQ(run_hitpipe({"compare", a, b, "--tolerance", "1"}).exit_code, 0);
}

TEST_F(CompareCommand, BadInputRejected) {
  const std::string a = rendered("a.png", "0,50,0");
  const std::string none = file("none.png");
  rejected({"compare", a, none}, "image file \"" + none + "\": no such file; check the name");
  std::ofstream(none) << contents_of(a).substr(0, 200);
  rejected({"compare", none, a},
           "image file \"" + none + "\": a damaged PNG, it ends within a chunk; give a whole one");
  const Outcome other = run_hitpipe(
      {"render", "--scene", "spheres", "--width", "16", "--height", "24", "--out", file("other.png")});
  EXPECT_EQ(other.exit_code, 0) << other.err;
  rejected({"compare", a, file("other.png")},
           "24 x 16 pixels of 3 channels and 16 x 24 of 3; images must be alike in all three");
  rejected({"compare", a}, "b is required; see hitpipe compare --help");
  const Outcome negative = run_hitpipe({"compare", a, a, "--tolerance", "-1"});
  EXPECT_NE(negative.exit_code, 0);
  EXPECT_THAT(negative.err,
              testing::MatchesRegex("hitpipe: --tolerance: [^\n]+; see hitpipe compare --help\n"));
}

}  // namespace
}  // namespace hitpipe::cli::compare_command_test
