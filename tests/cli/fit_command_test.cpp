// `hitpipe fit`: what is left out and proved, in three formats, and the files of the fitted unit.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/program.hpp"

namespace hitpipe::cli {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// An octahedron of mirrors, seen and lit from within its own box: whatever a unit can do is asked of it.
constexpr const char* octahedron = R"(v -1 0 0
v 0 -1 0
v 0 0 -1
v 1 0 0
v 0 1 0
v 0 0 1
f 1 2 3
f 4 2 3
f 1 5 3
f 4 5 3
f 1 2 6
f 4 2 6
f 1 5 6
f 4 5 6
)";
constexpr const char* scene = R"({"mesh": "octahedron.obj",
  "camera": {"eye": [0.9, 0.8, 0.95], "target": [0, 0, 0.1]},
  "lights": [{"position": [-0.5, 0.9, 0.95]}],
  "materials": {"mirror": {"albedo": 0.5, "reflect": 0.4}},
  "default_material": "mirror"})";

class FitCommand : public testing::Test {
 protected:
  FitCommand() {
    folder_.write("octahedron.obj", octahedron);
    scene_ = folder_.write("scene.json", scene).string();
  }
  [[nodiscard]] std::string out() const { return (folder_.path() / "out").string(); }
  [[nodiscard]] Outcome fit(const std::vector<std::string>& more) const {
    std::vector<std::string> arguments{"fit", "--scene",   scene_,      "--width", "24", "--height",
                                       "20",  "--designs", "int_slabs", "--out",   out()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_hitpipe(arguments);
  }

  sim::TemporaryFolder folder_;
  std::string scene_;
};

TEST_F(FitCommand, KeepsEveryByteOfADesignThatIsNeededWhole) {
  const Outcome outcome = fit({"--keep-bits", "--bits", "12/12", "--format", "json"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const json row = json::parse(outcome.out).at(0);
  EXPECT_EQ(row.at("design"), "int_slabs");
  EXPECT_EQ(row.at("bits"), "12/12");
  EXPECT_EQ(row.at("area_before_mm2"), row.at("area_after_mm2"));
  EXPECT_EQ(row.at("area_saved_pct"), 0.0);
  EXPECT_EQ(row.at("bytes_per_node"), 17);
  EXPECT_EQ(row.at("different_triangles"), 0);
  EXPECT_EQ(row.at("false_misses"), 0);
  EXPECT_EQ(row.at("rtl_mismatches"), 0);
  EXPECT_TRUE(row.at("extra_box_tests_pct").is_number());
  EXPECT_TRUE(row.at("left_out").empty());
  const std::string whole = (folder_.path() / "whole").string();
  EXPECT_EQ(run_hitpipe({"rtl", "int_slabs", "--bits", "12/12", "--out", whole}).exit_code, 0);
  const auto files = files_below(whole);
  EXPECT_EQ(files_below(out() + "/int_slabs"), files);
  for (const std::string& file : files)
    EXPECT_EQ(contents_of(out() + "/int_slabs/" + file), contents_of(whole + "/" + file)) << file;
}

TEST_F(FitCommand, FindsFewerBitsAndSaysSo) {
  const Outcome outcome = fit({"--bits", "24/24", "--overhead", "900"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(outcome.out, HasSubstr("rays: primary, secondary, shadow\n"));
  EXPECT_THAT(outcome.out, HasSubstr("bits: 6/6 instead of 24/24 ("));
  EXPECT_LE(widest_line(outcome.out.substr(outcome.out.find("design "), 160)), 80U);
}

TEST_F(FitCommand, RejectsWhatIsNotThere) {
  EXPECT_THAT(fit({"--designs", "int_cubes"}).err, HasSubstr("design int_cubes: unknown"));
  EXPECT_THAT(fit({"--bits", "99/3"}).err, HasSubstr("bits 99/3: allowed is n/t"));
  EXPECT_THAT(fit({"--overhead", "-1"}).err, HasSubstr("--overhead"));
  EXPECT_FALSE(std::filesystem::exists(out()));
}

}  // namespace
}  // namespace hitpipe::cli
