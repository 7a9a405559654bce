// Differences of images, files that are read or refused, and the colours of maps.
#include "sw_ref/render/image_compare.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "sw_ref/render/colour_map.hpp"
#include "tests/message_of.hpp"

namespace hitpipe::ref::image_compare_test {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

StoredImage image(std::vector<float> values) {
  return {2, 1, static_cast<int>(values.size() / 2), std::move(values)};
}

TEST(CompareImages, EqualImagesDoNotDiffer) {
  const StoredImage a = image({0.0F, 0.25F, 1.0F, 7.0F, NAN, infinity});
  const ImageDifference difference = compare_images(a, a, 0.0);
  EXPECT_EQ(difference.pixels, 2U);
  EXPECT_EQ(difference.different_pixels, 0U);
  EXPECT_EQ(difference.largest, 0.0);
  EXPECT_EQ(difference.mean, 0.0);
  EXPECT_EQ(difference.psnr_db, INFINITY);
  EXPECT_EQ(difference.per_pixel, (std::vector<float>{0.0F, 0.0F}));
}

TEST(CompareImages, FiguresAreTheirDefinitions) {
  const StoredImage a = image({0.0F, 0.5F, 1.0F, 0.25F, 0.5F, 0.75F});
  const StoredImage b = image({0.0F, 0.5F, 0.5F, 0.25F, 0.75F, 0.75F});
  const ImageDifference difference = compare_images(a, b, 0.0);
  EXPECT_EQ(difference.different_pixels, 2U);
  EXPECT_EQ(difference.largest, 0.5);
  EXPECT_DOUBLE_EQ(difference.mean, 0.75 / 6);
  EXPECT_DOUBLE_EQ(difference.psnr_db, 10 * std::log10(6 / (0.25 + 0.0625)));
  EXPECT_EQ(difference.per_pixel, (std::vector<float>{0.5F, 0.25F}));
  EXPECT_EQ(compare_images(a, b, 0.25).different_pixels, 1U);
  EXPECT_EQ(compare_images(a, b, 0.5).different_pixels, 0U);
}

TEST(CompareImages, NumbersAreInfinitelyFarFromWhatIsNone) {
  for (const float odd : {NAN, infinity, -infinity}) {
    const ImageDifference difference = compare_images(image({odd, 0.0F}), image({0.0F, 0.0F}), 1e300);
    EXPECT_EQ(difference.different_pixels, 1U);
    EXPECT_EQ(difference.largest, INFINITY);
    EXPECT_EQ(difference.psnr_db, -INFINITY);
  }
  EXPECT_EQ(compare_images(image({infinity, 0.0F}), image({-infinity, 0.0F}), 0.0).largest, INFINITY);
}

TEST(CompareImages, ImagesOfOtherSizesRejected) {
  const StoredImage a = image({0.0F, 0.0F});
  EXPECT_EQ(message_of<std::exception>([&] {
              (void)compare_images(a, image({0.0F, 0.0F, 0.0F, 0.0F}), 0.0);
            }),
            "2 x 1 pixels of 1 channels and 2 x 1 of 2; images must be alike in all three");
  EXPECT_EQ(message_of<std::exception>([&] {
              (void)compare_images(a, {1, 2, 1, {0.0F, 0.0F}}, 0.0);
            }),
            "2 x 1 pixels of 1 channels and 1 x 2 of 1; images must be alike in all three");
}

TEST(ScaleOf, IsOfFiniteValues) {
  const auto scale = [](const std::vector<float>& values) {
    const MapScale s = scale_of(values);
    return std::pair(s.low, s.high);
  };
  EXPECT_EQ(scale({3.0F, infinity, -2.0F, NAN}), std::pair(-2.0F, 3.0F));
  EXPECT_EQ(scale({infinity, NAN}), std::pair(0.0F, 0.0F));
  EXPECT_EQ(scale({}), std::pair(0.0F, 0.0F));
}

TEST(Viridis, GrowsBrighterFromEndToEnd) {
  EXPECT_EQ(viridis(0.0F), (Srgb{0x44, 0x01, 0x54}));
  EXPECT_EQ(viridis(-5.0F), viridis(0.0F));
  EXPECT_EQ(viridis(0.5F), (Srgb{0x21, 0x90, 0x8C}));
  EXPECT_EQ(viridis(0.0625F), (Srgb{0x46, 0x17, 0x68}));  // half-way between the first two anchors
  EXPECT_EQ(viridis(1.0F), (Srgb{0xFD, 0xE7, 0x25}));
  EXPECT_EQ(viridis(infinity), viridis(1.0F));
  EXPECT_EQ(viridis(NAN), (Srgb{0, 0, 0}));
  double before = 0.0;
  for (int i = 0; i <= 255; ++i) {
    const Srgb colour = viridis(static_cast<float>(i) / 255.0F);
    const double luma = 0.2126 * colour[0] + 0.7152 * colour[1] + 0.0722 * colour[2];
    EXPECT_GE(luma, before - 0.5) << i;  // codes are rounded
    before = luma;
  }
}

class ImageOnDisk : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  static std::string error(const std::filesystem::path& file) {
    return message_of<std::exception>([&] { (void)read_image(file); });
  }

  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / fmt::format("hitpipe_image_on_disk_{}", ::getpid());
};

TEST_F(ImageOnDisk, ReadsWhatWasWritten) {
  write_image(folder_ / "a.exr", 2, 1, {{0.0F, 0.5F, 1.0F}, {0.25F, 2.0F, 4.0F}});
  const StoredImage exr = read_image(folder_ / "a.exr");
  EXPECT_EQ(exr.width, 2);
  EXPECT_EQ(exr.height, 1);
  EXPECT_EQ(exr.channels, 3);
  EXPECT_EQ(exr.values, (std::vector<float>{0.0F, 0.5F, 1.0F, 0.25F, 2.0F, 4.0F}));
  write_image(folder_ / "a.png", 1, 1, {{0.0F, 0.5F, 1.0F}});
  EXPECT_THAT(read_image(folder_ / "a.png").values,
              testing::Pointwise(testing::FloatNear(1e-6F), {0.0F, 188.0F / 255.0F, 1.0F}));
}

TEST_F(ImageOnDisk, MapsAreValuesAsTheyAreOrColours) {
  const std::vector<float> values{1.0F, 5.0F, 123456.789F, infinity};
  write_map(folder_ / "m.exr", 2, 2, values, {});
  const StoredImage exr = read_image(folder_ / "m.exr");
  EXPECT_EQ(exr.channels, 1);
  EXPECT_EQ(exr.values, values);
  write_map(folder_ / "m.png", 2, 2, values, {1.0F, 9.0F});
  std::vector<float> expected;
  for (const Srgb& colour : {viridis(0.0F), viridis(0.5F), viridis(1.0F), Srgb{0, 0, 0}})
    for (const std::uint8_t code : colour) expected.push_back(static_cast<float>(code) / 255.0F);
  EXPECT_THAT(read_image(folder_ / "m.png").values, testing::Pointwise(testing::FloatNear(1e-6F), expected));
  write_map(folder_ / "flat.png", 2, 1, std::vector<float>{3.0F, 3.0F}, {3.0F, 3.0F});
  EXPECT_NEAR(read_image(folder_ / "flat.png").values[0], expected[0], 1e-6);
}

TEST_F(ImageOnDisk, DamagedFilesRejectedInOneLineAlone) {
  const auto cut = [&](const char* extension, double kept) {
    const std::filesystem::path file = folder_ / fmt::format("cut.{}", extension);
    write_image(file, 64, 64, std::vector<glm::vec3>(64 * 64, glm::vec3(0.5F)));
    std::filesystem::resize_file(
        file, static_cast<std::uintmax_t>(kept * static_cast<double>(std::filesystem::file_size(file))));
    testing::internal::CaptureStderr();
    const std::string message = error(file);
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    EXPECT_EQ(message.find('\n'), std::string::npos);
    const std::string start = fmt::format("image file \"{}\": ", file.string());
    EXPECT_THAT(message, testing::StartsWith(start));
    return message.substr(start.size());
  };
  for (const double kept : {0.0, 0.02, 0.5})
    EXPECT_THAT(cut("exr", kept),
                testing::StartsWith("OpenImageIO cannot read it; give a whole .png or .exr ("));
  EXPECT_THAT(cut("png", 0.0),
              testing::StartsWith("OpenImageIO cannot read it; give a whole .png or .exr ("));
  EXPECT_EQ(cut("png", 0.5), "a damaged PNG, it ends within a chunk; give a whole one");
  write_image(folder_ / "a.png", 1, 1, {glm::vec3(0.5F)});
  const auto size = std::filesystem::file_size(folder_ / "a.png");
  std::fstream(folder_ / "a.png", std::ios::in | std::ios::out | std::ios::binary).seekp(16).put('\1');
  EXPECT_THAT(error(folder_ / "a.png"),
              testing::EndsWith("a damaged PNG, a checksum is wrong; give a whole one"));
  write_image(folder_ / "a.png", 1, 1, {glm::vec3(0.5F)});
  std::filesystem::resize_file(folder_ / "a.png", size - 12);  // without the chunk IEND
  EXPECT_THAT(error(folder_ / "a.png"),
              testing::EndsWith("a damaged PNG, its end is missing; give a whole one"));
}

TEST_F(ImageOnDisk, WhatIsNoImageRejected) {
  EXPECT_EQ(error("/no/such/a.png"), "image file \"/no/such/a.png\": no such file; check the name");
  EXPECT_EQ(error(folder_),
            fmt::format("image file \"{}\": is a folder; give the name of a file", folder_.string()));
  std::ofstream(folder_ / "text.txt") << "no image\n";
  EXPECT_THAT(error(folder_ / "text.txt"), testing::HasSubstr("OpenImageIO cannot read it"));
  EXPECT_THAT(
      message_of<std::exception>([&] { write_map(folder_ / "a.jpg", 1, 1, std::vector<float>{1.0F}, {}); }),
      testing::EndsWith("unknown extension \".jpg\"; allowed are .png and .exr"));
  EXPECT_THAT(
      message_of<std::exception>([&] { write_map(folder_ / "a.png", 2, 1, std::vector<float>{1.0F}, {}); }),
      testing::HasSubstr("1 pixels do not fill 2 x 1"));
}

}  // namespace
}  // namespace hitpipe::ref::image_compare_test
