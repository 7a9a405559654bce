// `hitpipe image`: the file has the blocks that the library makes, and the figures are of that file.
#include <cstring>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "sw_ref/core/core_image.hpp"
#include "sw_ref/scene/built_in.hpp"
#include "tests/cli/program.hpp"

namespace hitpipe::cli::image_command_test {
namespace {

using testing::HasSubstr;

class ImageCommand : public testing::Test {
 protected:
  sim::TemporaryFolder folder_;
  const std::filesystem::path file_ = folder_.path() / "scene.bin";
};

TEST_F(ImageCommand, WritesTheBlocks) {
  const Outcome outcome = run_hitpipe(
      {"image", "--scene", "spheres", "--bits", "16+1s16", "--out", file_.string(), "--format", "json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto row = nlohmann::json::parse(outcome.out);
  const std::string bytes = contents_of(file_);
  EXPECT_EQ(bytes.size(), row.at("bytes").get<std::size_t>());
  EXPECT_EQ(row.at("hierarchy"), "sah 2");
  std::vector<ref::CoreBlock> blocks(bytes.size() / ref::core_block_bytes);
  std::memcpy(blocks.data(), bytes.data(), bytes.size());
  const ref::CoreImage image = ref::checked_image(std::move(blocks));
  EXPECT_EQ(image.triangles, row.at("triangles").get<std::uint32_t>());
  EXPECT_EQ(image.records, row.at("records").get<std::uint32_t>());
  EXPECT_EQ(image.triangles, 24578U);
}

TEST_F(ImageCommand, SaysWhatRaysRead) {
  const Outcome outcome = run_hitpipe({"image", "--scene", "spheres", "--width", "16", "--height", "16",
                                       "--stack", "0,8", "--format", "csv"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out,
              HasSubstr("stack,rays,records_a_ray,triangles_a_ray,restarts_a_ray,bytes_a_ray\n0,"));
  EXPECT_THAT(outcome.out, HasSubstr("\n8,"));
}

TEST_F(ImageCommand, RefusesWhatItCannotDo) {
  const auto refused = [&](std::vector<std::string> more) {
    std::vector<std::string> words{"image", "--scene", "spheres", "--out", file_.string()};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = run_hitpipe(words);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_FALSE(std::filesystem::exists(file_));
    return outcome.err;
  };
  EXPECT_THAT(refused({"--bits", "20/24"}), HasSubstr("n+gsS"));
  EXPECT_THAT(refused({"--stack", "61"}), HasSubstr("0 to 60"));
  EXPECT_THAT(refused({"--padding", "0"}), HasSubstr("--padding"));
}

}  // namespace
}  // namespace hitpipe::cli::image_command_test
