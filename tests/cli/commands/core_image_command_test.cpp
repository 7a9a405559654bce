// `hitpipe core image`: the file has the blocks that the library makes, and the figures are of that file.
#include <algorithm>
#include <cstring>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "rays/image/core_image.hpp"
#include "sw_ref/scene/built_in.hpp"
#include "tests/cli/program.hpp"

namespace hitpipe::cli::image_command_test {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;

class ImageCommand : public testing::Test {
 protected:
  sim::TemporaryFolder folder_;
  const std::filesystem::path file_ = folder_.path() / "scene.bin";
};

TEST_F(ImageCommand, WritesTheBlocks) {
  const Outcome outcome = run_hitpipe({"core", "image", "--scene", "spheres", "--bits", "16+1s16", "--out",
                                       file_.string(), "--format", "json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto row = nlohmann::json::parse(outcome.out);
  const std::string bytes = contents_of(file_);
  EXPECT_EQ(bytes.size(), row.at("bytes").get<std::size_t>());
  EXPECT_EQ(row.at("hierarchy"), "sah 2");
  std::vector<ref::CoreBlock> blocks(bytes.size() / ref::core_block_bytes);
  std::memcpy(blocks.data(), bytes.data(), bytes.size());
  const ref::CoreImage image = ref::checked_image(std::move(blocks));
  EXPECT_EQ(image.header.triangles, row.at("triangles").get<std::uint32_t>());
  EXPECT_EQ(image.records, row.at("records").get<std::uint32_t>());
  EXPECT_EQ(image.header.triangles, 24578U);
}

TEST_F(ImageCommand, WritesBesideItWhereTheMeshLies) {
  // Of two triangles the first is so thin that the grid of 8 bits loses it.
  folder_.write("two.obj", "v 0 0 0\nv 1 0 0\nv 1 0.0001 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\n");
  const Outcome outcome = run_hitpipe({"core", "image", "--scene", (folder_.path() / "two.obj").string(),
                                       "--bits", "8+0s8", "--cube", "0,0,0,2", "--out", file_.string()});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto beside = nlohmann::json::parse(contents_of(file_.string() + ".json"));
  EXPECT_EQ(beside.at("dropped_triangles"), nlohmann::json::array({0}));
  EXPECT_NEAR(beside.at("cube").at("scale").get<double>(), 0.5, 0.001);  // and a margin
  EXPECT_EQ(beside.at("units_of_a_corner_in_half_the_cube"), 63);
  EXPECT_EQ(beside.at("image").at("blocks"), 6);
}

TEST_F(ImageCommand, ChecksAFile) {
  ASSERT_EQ(run_hitpipe({"core", "image", "--scene", "spheres", "--out", file_.string()}).exit_code, 0);
  const Outcome whole = run_hitpipe({"core", "image", "--check", file_.string()});
  EXPECT_EQ(whole.exit_code, 0) << whole.err;
  EXPECT_THAT(whole.out, ContainsRegex("triangles +24,578\n"));
  EXPECT_THAT(whole.out, ContainsRegex("offset +0,4\\.25,0\\.2[0-9]*\nscale +0\\.1085[0-9]+\n"));
  const auto complaint = [&](const std::string& bytes) {
    folder_.write("scene.bin", bytes);
    const Outcome outcome = run_hitpipe({"core", "image", "--check", file_.string()});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.out, "");
    return outcome.err;
  };
  const std::string bytes = contents_of(file_);
  const std::string start = "hitpipe: " + file_.string() + ": ";
  EXPECT_THAT(complaint(bytes.substr(0, 600'000)),
              ContainsRegex(start + "there are 18750 blocks; allowed are [0-9]+, as the header says\n"));
  EXPECT_EQ(complaint(bytes.substr(0, 600'001)),
            start + "there are 600001 bytes; allowed are whole blocks of 32\n");
  std::string half = bytes;
  std::fill(half.begin() + 600'000, half.end(), '\0');
  EXPECT_EQ(complaint(half), start + "the checksum differs: the image was changed or half written\n");
  EXPECT_EQ(complaint(std::string(100'000, '\0')),
            start + "there is no header; allowed is a file of `hitpipe core image`\n");
}

TEST_F(ImageCommand, RefusesMoreBlocksThanACoreReads) {
  const Outcome outcome =
      run_hitpipe({"core", "image", "--scene", "spheres", "--block-bits", "12", "--out", file_.string()});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err,
              ContainsRegex("--block-bits 12: the image has [0-9]+ blocks; allowed is 16 and more"));
  EXPECT_FALSE(std::filesystem::exists(file_));
}

TEST_F(ImageCommand, SaysWhatRaysRead) {
  const Outcome outcome = run_hitpipe({"core", "image", "--scene", "spheres", "--width", "16", "--height",
                                       "16", "--stack", "0,8", "--format", "csv"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out,
              HasSubstr("stack,rays,records_a_ray,triangles_a_ray,restarts_a_ray,bytes_a_ray\n0,"));
  EXPECT_THAT(outcome.out, HasSubstr("\n8,"));
}

// A core with one ray in flight reads block after block, as the walk in software does.
TEST_F(ImageCommand, BytesBehindACacheAreThoseOfACoreWithOneRay) {
  const std::vector<std::string> picture{"--scene",  "statue", "--width",  "16",
                                         "--height", "16",     "--format", "json"};
  const auto row_of = [&](std::vector<std::string> words) {
    words.insert(words.end(), picture.begin(), picture.end());
    const Outcome outcome = run_hitpipe(words);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return nlohmann::json::parse(outcome.out).at(0);
  };
  const auto walked = row_of({"core", "image", "--stack", "8", "--cache", "4,64"});
  const std::vector<std::string> core{"core", "trace", "--native", "--stack", "8", "--rays-in-flight", "1"};
  for (const auto& [kib, column] : {std::pair{"4", "bytes_a_ray_4kib"}, std::pair{"64", "bytes_a_ray_64kib"},
                                    std::pair{"0", "bytes_a_ray"}}) {
    std::vector<std::string> words = core;
    words.insert(words.end(), {"--cache", kib});
    EXPECT_EQ(row_of(words).at("bytes_a_ray"), walked.at(column)) << kib;
  }
  EXPECT_LT(walked.at("bytes_a_ray_64kib"), walked.at("bytes_a_ray_4kib"));
  const auto small_lines = [&](std::vector<std::string> words) {
    words.insert(words.end(), {"--cache", "4", "--cache-line", "32", "--cache-ways", "4"});
    return row_of(words);
  };
  EXPECT_EQ(small_lines(core).at("bytes_a_ray"),
            small_lines({"core", "image", "--stack", "8"}).at("bytes_a_ray_4kib"));
}

TEST_F(ImageCommand, ShowsCachesInALineEach) {
  const Outcome outcome = run_hitpipe({"core", "image", "--scene", "statue", "--width", "16", "--height",
                                       "16", "--stack", "2,8", "--cache", "4", "--cache-ways", "1"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, ContainsRegex("\nstack +2\n(.*\n)*bytes_a_ray_4kib .*\n\nstack +8\n"));
}

TEST_F(ImageCommand, RefusesWhatItCannotDo) {
  const auto refused = [&](std::vector<std::string> more) {
    std::vector<std::string> words{"core", "image", "--scene", "spheres", "--out", file_.string()};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = run_hitpipe(words);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_FALSE(std::filesystem::exists(file_));
    return outcome.err;
  };
  EXPECT_THAT(refused({"--bits", "20/24"}), HasSubstr("n+gsS"));
  EXPECT_THAT(refused({"--stack", "61"}), HasSubstr("0 to 60"));
  EXPECT_THAT(refused({"--padding", "0"}), HasSubstr("--padding"));
  EXPECT_THAT(refused({"--cache", "4"}), HasSubstr("--stack"));
}

}  // namespace
}  // namespace hitpipe::cli::image_command_test
