// `hitpipe fit`: what is left out and checked, in three formats, and the files of the fitted unit.
#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/program.hpp"

namespace hitpipe::cli::fit_command_test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// An octahedron of mirrors, seen and lit from inside its own box, so the scene needs everything that a unit
/// can do.
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
    return run_hitpipe(with({"fit", "--scene", scene_, "--width", "24", "--height", "20", "int_slabs",
                             "--out", out(), "--vectors", "2000"},
                            more));
  }

  sim::TemporaryFolder folder_;
  std::string scene_;
};

/// The cuts, in the order of their lines.
std::vector<double> shares_in(const std::string& text) {
  std::vector<double> shares;
  for (const std::string& line : lines_of(text)) {
    const std::size_t percent = line.find(" %  ");
    if (percent != std::string::npos) shares.push_back(std::stod(line.substr(0, percent)));
  }
  return shares;
}

TEST_F(FitCommand, KeepsEveryByteOfADesignThatIsNeededWhole) {
  const Outcome outcome = fit({"--keep-bits", "--bits", "12/12", "--format", "json"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const json row = json::parse(outcome.out).at(0);
  EXPECT_EQ(row.at("design"), "int_slabs");
  EXPECT_EQ(row.at("bits"), "12/12");
  EXPECT_EQ(row.at("area_before_mm2"), row.at("area_after_mm2"));
  EXPECT_EQ(row.at("area_saved_pct"), 0.0);
  EXPECT_EQ(row.at("dropped_bits"), json::array({0, 0, 0}));
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
  // The vectors of a fitted unit are others, because they meet the scene's demands.
  for (const std::string& file : files) {
    if (file.starts_with("tb/")) continue;
    EXPECT_EQ(contents_of(out() + "/int_slabs/" + file), contents_of(whole + "/" + file)) << file;
  }
}

/// The text of a scene that needs everything: what is kept, why, what it costs, and a unit of fewer bits.
TEST_F(FitCommand, LeavesOutARateThatIsNotAskedFor) {
  const std::vector<std::string> bits{"--keep-bits", "--bits", "12/12"};
  const Outcome text = fit(with(bits, {"--rate-boxes", "60e6"}));
  EXPECT_EQ(text.exit_code, 0) << text.err;
  EXPECT_LE(widest_line(text.out), 80U) << text.out;
  EXPECT_THAT(text.out,
              testing::ContainsRegex("rate: a test every [0-9]+ cycles\n +60 million boxes a second"));
  EXPECT_THAT(text.out, HasSubstr("  takes "));
  const Outcome every_third = fit(with(bits, {"--ii", "3", "--format", "json"}));
  const json row = json::parse(every_third.out).at(0);
  EXPECT_EQ(row.at("ii"), 3);
  EXPECT_EQ(row.at("rtl_mismatches"), 0);
  EXPECT_GT(row.at("boxes_per_second"), row.at("rays_per_second"));
  const Outcome too_fast = fit(with(bits, {"--rate-rays", "1e9"}));
  EXPECT_EQ(too_fast.exit_code, 2);
  EXPECT_THAT(too_fast.err,
              testing::MatchesRegex("hitpipe: int_slabs 12/12: .* asked for; it takes .* at most\n"));
}

TEST_F(FitCommand, ComparesTheResultWithWhereTheSearchBegan) {
  const std::vector<std::string> bits{"--bits", "10/10"};
  const Outcome text = fit(bits);
  EXPECT_EQ(text.exit_code, 0) << text.err;
  EXPECT_LE(widest_line(text.out), 80U);
  EXPECT_THAT(text.out, HasSubstr("\n  compared by whole cost in mm² ms: before 10/10 "));
  EXPECT_THAT(text.out, HasSubstr("result "));
  const json row = json::parse(fit(with(bits, {"--format", "json"})).out).at(0);
  EXPECT_LE(row.at("search_cost"), row.at("search_cost_before"));
  EXPECT_NEAR(row.at("search_cost").get<double>(), row.at("whole_area_run_time_mm2_ms").get<double>(),
              0.05 * row.at("search_cost").get<double>());
  EXPECT_THAT(row.at("search_starts").at(0).get<std::string>(), testing::StartsWith("10/10 "));
  const json by_area =
      json::parse(
          fit({"--bits", "8/8", "--rate-boxes", "100e6", "--overhead", "900", "--format", "json"}).out)
          .at(0);
  EXPECT_EQ(by_area.at("search_measure"), "area in mm²");
  EXPECT_NEAR(by_area.at("search_cost"), by_area.at("area_after_mm2"), 0.01);
  const json kept = json::parse(fit(with(bits, {"--keep-bits", "--format", "json"})).out).at(0);
  EXPECT_TRUE(kept.at("search_cost").is_null());
  EXPECT_TRUE(kept.at("search_starts").empty());
}

TEST_F(FitCommand, SaysWhatIsKeptWhyAndWhatItCosts) {
  const Outcome whole = fit({"int_slabs", "--keep-bits", "--bits", "12/12"});
  EXPECT_EQ(whole.exit_code, 0) << whole.err;
  EXPECT_LE(widest_line(whole.out), 80U);
  const std::string kept = whole.out.substr(whole.out.find("What cannot be bounded is kept\n"));
  for (const char* const text :
       {"  lengths and endpoints of rays\n    they move with every hit\n",
        "  spread of direction components not bounded\n",
        "\nint_slabs 12/12\n  left out: nothing, the scene needs it all\n",
        "  ports kept whole: irx, iry, irz, ", "\n  whole cost ",
        "\nLeast whole area × time: int_slabs 12/12: ",
        "\nWhole counts box tests, triangle tests and the divisions of ray set-up. A\n"})
    EXPECT_THAT(kept, HasSubstr(text));
  const Outcome fewer = fit({"--bits", "24/24", "--overhead", "900"});
  EXPECT_EQ(fewer.exit_code, 0) << fewer.err;
  EXPECT_THAT(fewer.out, HasSubstr("rays: primary, secondary, shadow\n"));
  EXPECT_THAT(fewer.out, HasSubstr("\nint_slabs 6/6, 24/24 before\n"));
  EXPECT_THAT(fewer.out, HasSubstr(" %  bits: 6/6 instead of 24/24\n"));
  EXPECT_LE(widest_line(fewer.out), 80U);
}

TEST_F(FitCommand, FailsWhenVectorsFindWhatTheImageDoesNot) {
  // A Verilator that damages its input: tests are lost while answers wait, which the rays never cause. Its
  // own version keeps its models apart from undamaged models.
  const std::string verilator = folder_
                                    .write_program("verilator", R"(#!/bin/sh
if [ "$1" = --version ]; then echo losing tests; exit; fi
if [ "$1" = --cc ]; then sed -i 's/else if (advance) valid/else valid/' int_slabs*.v; fi
exec verilator "$@"
)")
                                    .string();
  const Outcome outcome = run_hitpipe({"fit", "--scene", scene_, "--width", "8", "--height", "8", "int_slabs",
                                       "--keep-bits", "--bits", "12/12", "--vectors", "500", "--out", out()},
                                      {{"VERILATOR", verilator}});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(lines_of(outcome.err).size(), 1U) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("hitpipe: int_slabs 12/12 fitted to scene: "));
  EXPECT_THAT(outcome.err, HasSubstr(" vector mismatches, 0 RTL mismatches, 0 different triangles, 0 false "
                                     "misses; all must be 0; first vector: hit "));
  EXPECT_THAT(outcome.err, HasSubstr(" of seed 1: irx=0x"));
}

TEST_F(FitCommand, ListsCutsLargestFirstAndWritesACheckBesideTheWholeDesignsFiles) {
  const std::string whole = (folder_.path() / "whole").string();
  EXPECT_EQ(run_hitpipe({"rtl", "int_slabs", "--bits", "12/12", "--out", whole}).exit_code, 0);
  const Outcome outcome =
      run_hitpipe({"fit", "--scene", "spheres", "--no-shadows", "--width", "16", "--height", "16",
                   "int_slabs", "--keep-bits", "--bits", "12/12", "--vectors", "1000", "--out", out()});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_LE(widest_line(outcome.out), 80U);
  const std::vector<double> shares = shares_in(outcome.out);
  EXPECT_GT(shares.size(), 1U);
  EXPECT_TRUE(std::is_sorted(shares.rbegin(), shares.rend())) << outcome.out;
  std::vector<std::string> files = files_below(whole);
  files.emplace_back("int_slabs_12_12_check.v");
  EXPECT_THAT(files_below(out() + "/int_slabs"), testing::UnorderedElementsAreArray(files));
  EXPECT_THAT(contents_of(out() + "/int_slabs/int_slabs_12_12.core"),
              HasSubstr("files: [int_slabs_12_12_check.v]"));
}

TEST_F(FitCommand, WrittenUnitRunsAgainAndRefusesWhatItWasNotFittedTo) {
  ASSERT_EQ(run_hitpipe({"fit", "--scene", "spheres", "--no-shadows", "--width", "16", "--height", "16",
                         "int_slabs", "--keep-bits", "--bits", "12/12", "--vectors", "1000", "--out", out()})
                .exit_code,
            0);
  const std::string unit = out() + "/int_slabs";
  const auto cosim = [&](const std::vector<std::string>& more) {
    return run_hitpipe(with({"cosim", "int_slabs", "--unit", unit, "--width", "16", "--height", "16"}, more));
  };
  const Outcome same = cosim({"--scene", "spheres", "--referee", "--format", "json"});
  EXPECT_EQ(same.exit_code, 0) << same.err;
  const json row = json::parse(same.out);
  EXPECT_EQ(row.at("bits"), "12/12");
  EXPECT_EQ(row.at("rtl_mismatches"), 0);
  EXPECT_EQ(row.at("false_misses"), 0);
  EXPECT_GT(row.at("hits"), 0);

  const Outcome other = cosim({"--scene", "waves"});
  EXPECT_NE(other.exit_code, 0);
  EXPECT_THAT(other.err, HasSubstr("hitpipe: operands outside the demands that the unit was fitted to: i"));
  EXPECT_EQ(lines_of(other.err).size(), 1U) << other.err;
  EXPECT_THAT(cosim({"--scene", "spheres", "--bits", "12/12"}).err, HasSubstr("--unit excludes --bits: "));

  const std::string manifest = contents_of(unit + "/int_slabs_12_12.json");
  const auto error_with = [&](const std::string& text) {
    folder_.write("out/int_slabs/int_slabs_12_12.json", text);
    return cosim({"--scene", "spheres"}).err;
  };
  EXPECT_THAT(error_with("no JSON"),
              HasSubstr("int_slabs_12_12.json: no manifest: it must be JSON with design, "));
  json damaged = json::parse(manifest);
  damaged["latency"] = 99;
  EXPECT_THAT(error_with(damaged.dump()), HasSubstr("int_slabs_12_12.json: a latency of 99 cycles, "));
  damaged = json::parse(manifest);
  damaged["design"] = "int_plucker";
  EXPECT_THAT(error_with(damaged.dump()),
              HasSubstr("the manifest of int_plucker; allowed is a manifest of int_slabs"));
  damaged = json::parse(manifest);
  damaged["demands"][0]["port"] = "nowhere";
  EXPECT_THAT(error_with(damaged.dump()), HasSubstr("demand on nowhere: no such port; "));
  std::filesystem::remove(unit + "/int_slabs_12_12.json");
  EXPECT_THAT(cosim({"--scene", "spheres"}).err, HasSubstr("no manifest of int_slabs; give a folder "));
}

}  // namespace
}  // namespace hitpipe::cli::fit_command_test
