// `hitpipe core trace`: a core answers every ray of a picture, and the figures say how busy it was.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "sw_ref/render/image_file.hpp"
#include "tests/cli/program.hpp"

namespace hitpipe::cli::trace_command_test {
namespace {

using testing::HasSubstr;

std::vector<std::string> words(std::vector<std::string> more) {
  std::vector<std::string> all{"core", "trace", "--scene", "spheres", "--width", "24", "--height", "24"};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

nlohmann::json rows_of(const std::vector<std::string>& more) {
  std::vector<std::string> all = words(more);
  all.insert(all.end(), {"--native", "--format", "json"});
  const Outcome outcome = run_hitpipe(all);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  return nlohmann::json::parse(outcome.out);
}

TEST(TraceCommand, MoreRaysInFlightKeepThePortBusy) {
  const nlohmann::json rows = rows_of({"--rays-in-flight", "1,16,128"});
  ASSERT_EQ(rows.size(), 3U);
  double busy = 0;
  for (const nlohmann::json& row : rows) {
    EXPECT_EQ(row.at("wrong"), 0);
    EXPECT_EQ(row.at("reads_a_ray"), rows.at(0).at("reads_a_ray"));
    EXPECT_GT(row.at("port_busy_pct"), 1.5 * busy);
    busy = row.at("port_busy_pct");
    EXPECT_NEAR(row.at("cycles_a_ray").get<double>() * busy / 100, row.at("reads_a_ray").get<double>(), 1e-6);
  }
}

TEST(TraceCommand, SaysWhyCyclesWereLost) {
  const std::vector<std::string> shares{"port_busy_pct", "refused_pct", "idle_memory_pct", "idle_inside_pct",
                                        "idle_few_rays_pct"};
  // Each memory, and the cause that takes most of its cycles.
  const std::vector<std::pair<std::vector<std::string>, std::string>> causes{
      {{"--rays-in-flight", "2"}, "idle_memory_pct"},
      {{"--rays-in-flight", "2", "--latency", "1", "--triangle-ii", "64"}, "idle_inside_pct"},
      {{"--rays-in-flight", "64", "--refuse", "80"}, "refused_pct"},
      {{"--rays-in-flight", "64", "--latency", "4"}, "port_busy_pct"}};
  for (const auto& [more, cause] : causes) {
    const nlohmann::json row = rows_of(more).at(0);
    double sum = 0;
    for (const std::string& share : shares) {
      sum += row.at(share).get<double>();
      EXPECT_LE(row.at(share), row.at(cause)) << share << ", where most should be " << cause;
    }
    EXPECT_NEAR(sum, 100, 1e-6) << cause;
  }
}

TEST(TraceCommand, MemoriesOfEveryKindGiveTheSameAnswers) {
  const nlohmann::json plain = rows_of({});
  for (const auto& more : {std::vector<std::string>{"--latency", "1,200"},
                           {"--latency", "20", "--in-order"},
                           {"--data-bits", "64"},
                           {"--door", "float", "--data-bits", "512"},
                           {"--refuse", "50"},
                           {"--bits", "20+1s20", "--triangle-ii", "8"}}) {
    const nlohmann::json rows = rows_of(more);
    EXPECT_EQ(rows.at(0).at("wrong"), 0);
    EXPECT_EQ(rows.at(0).at("reads_a_ray"), plain.at(0).at("reads_a_ray"));
  }
  const nlohmann::json cached = rows_of({"--cache", "64"});
  EXPECT_GT(cached.at(0).at("cache_hits_pct"), 50);
  EXPECT_LT(cached.at(0).at("bytes_a_ray"), 32 * plain.at(0).at("reads_a_ray").get<double>());
  EXPECT_GT(rows_of({"--refuse", "50"}).at(0).at("refused_pct"), 40);
}

TEST(TraceCommand, VerilogPrintsWhatSoftwarePrints) {
  const std::vector<std::string> more{"--rays-in-flight", "12", "--latency", "1,40", "--refuse", "10"};
  std::vector<std::string> native = words(more);
  native.push_back("--native");
  const Outcome verilog = run_hitpipe(words(more));
  EXPECT_EQ(verilog.exit_code, 0) << verilog.err;
  EXPECT_EQ(verilog.out, run_hitpipe(native).out);
}

TEST(TraceCommand, WritesThePictureOfItsAnswers) {
  const sim::TemporaryFolder folder;
  const std::string out = (folder.path() / "core").string();
  rows_of({"--out", out});
  const ref::StoredImage picture = ref::read_image(folder.path() / "core" / "spheres.png");
  const std::string rendered = (folder.path() / "rendered.png").string();
  EXPECT_EQ(run_hitpipe({"render", "--scene", "spheres", "--width", "24", "--height", "24", "--world",
                         "integer", "--builder", "sah", "--max-triangles", "2", "--out", rendered})
                .exit_code,
            0);
  EXPECT_EQ(picture.values, ref::read_image(rendered).values);
}

TEST(TraceCommand, TracesTheRaysOfAFile) {
  const sim::TemporaryFolder folder;
  const std::string rays =
      folder.write("rays.csv", "ox,oy,oz,dx,dy,dz,any\n0,9,0,0,-1,0,0\n0,9,0,0.1,-1,0,1\n0,9,0,0,1,0,0\n")
          .string();
  const std::vector<std::string> words{"core",   "trace", "--scene",  "spheres",
                                       "--rays", rays,    "--format", "json"};
  for (const std::vector<std::string>& more : {std::vector<std::string>{}, {"--native"}}) {
    const Outcome outcome = run_hitpipe(with(words, more));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const nlohmann::json row = nlohmann::json::parse(outcome.out).at(0);
    EXPECT_EQ(row.at("rays"), 3);
    EXPECT_EQ(row.at("wrong"), 0);
    EXPECT_GT(row.at("reads_a_ray"), 1.0);
  }
  const Outcome picture = run_hitpipe(with(words, {"--out", (folder.path() / "out").string()}));
  EXPECT_EQ(picture.exit_code, 2);
  EXPECT_THAT(picture.err, HasSubstr("--rays excludes --out: the rays of a file make no picture"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out"));
}

TEST(TraceCommand, RefusesWhatItCannotDo) {
  const auto refused = [](const std::vector<std::string>& more) {
    const Outcome outcome = run_hitpipe(words(more));
    EXPECT_EQ(outcome.exit_code, 2);
    return outcome.err;
  };
  EXPECT_THAT(refused({"--rays-in-flight", "257"}), HasSubstr("1 to 256"));
  EXPECT_THAT(refused({"--stack", "7"}), HasSubstr("--stack 7: allowed is a power of two"));
  EXPECT_THAT(refused({"--latency", "9,3"}), HasSubstr("--latency 9,3: the first is the least"));
  EXPECT_THAT(refused({"--cache", "3"}), HasSubstr("power of two"));
  EXPECT_THAT(refused({"--bits", "20/24"}), HasSubstr("n+gsS"));
  EXPECT_THAT(refused({"--triangle-ii", "2"}), HasSubstr("3 to 64"));
}

}  // namespace
}  // namespace hitpipe::cli::trace_command_test
