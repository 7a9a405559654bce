// `hitpipe core fit`: what it prints and writes, and what it refuses.
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/program.hpp"
#include "tests/sim/temporary_folder.hpp"

namespace hitpipe::cli::core_fit_command_test {
namespace {

using testing::HasSubstr;

std::vector<std::string> words(const std::string& folder, std::vector<std::string> more) {
  std::vector<std::string> all{"core", "fit",      "--scene", "city",  "--width",
                               "16",   "--height", "16",      "--out", folder};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

TEST(CoreFitCommand, TracesTheSceneInVerilogAndWritesAllOfIt) {
  const sim::TemporaryFolder folder;
  const Outcome outcome =
      run_hitpipe(words(folder.path().string(), {"--bits", "10+0s10", "--rays", "4", "--format", "json"}));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const nlohmann::json fit = nlohmann::json::parse(outcome.out);
  ASSERT_EQ(fit.at("scenes").size(), 1U);
  EXPECT_GT(fit.at("scenes").at(0).at("rays"), 0);
  EXPECT_EQ(fit.at("scenes").at(0).at("wrong"), 0);
  EXPECT_EQ(fit.at("fitted").at("rays_in_flight"), 4);
  EXPECT_FALSE(fit.at("left_out").empty());
  EXPECT_EQ(nlohmann::json::parse(contents_of(folder.path() / "fit.json")), fit);
  const std::string verilog = fit.at("module").get<std::string>() + ".v";
  for (const std::string& file : {std::string("city.bin"), std::string("city.png"),
                                  std::string("city_different.png"), verilog, std::string("tb/Makefile")})
    EXPECT_TRUE(std::filesystem::exists(folder.path() / file)) << file;
}

TEST(CoreFitCommand, SaysWhatTheScenesNeedBesideAnOption) {
  const sim::TemporaryFolder folder;
  const Outcome outcome = run_hitpipe(
      words(folder.path().string(), {"--bits", "10+0s10", "--leaf-bits", "2", "--number-bits", "4"}));
  EXPECT_NE(outcome.exit_code, 0);
  EXPECT_THAT(outcome.err, HasSubstr("--number-bits 4: the scenes need"));
}

TEST(CoreFitCommand, RefusesOptionsThatWouldDoNothing) {
  const sim::TemporaryFolder folder;
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
      {{"--bits", "10+0s10", "--error", "1"}, "--error: excludes --bits"},
      {{"--for", "rate", "--rate-rays", "1000"}, "--rate-rays: needs --for area"},
      {{"--for", "rate", "--overhead", "1"}, "--overhead: needs --for area"}};
  for (const auto& [more, message] : cases) {
    const Outcome outcome = run_hitpipe(words(folder.path().string(), more));
    EXPECT_NE(outcome.exit_code, 0);
    EXPECT_THAT(outcome.err, HasSubstr(message));
  }
}

TEST(CoreFitCommand, RefusesALibraryBesideATarget) {
  const sim::TemporaryFolder folder;
  const Outcome outcome =
      run_hitpipe(words(folder.path().string(), {"--target", "xc7", "--library", "osu018"}));
  EXPECT_NE(outcome.exit_code, 0);
  EXPECT_THAT(outcome.err, HasSubstr("excludes"));
}

}  // namespace
}  // namespace hitpipe::cli::core_fit_command_test
