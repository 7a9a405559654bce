// Image files: they can be read back, and no half-written file is left if writing fails.
#include "sw_ref/render/image_file.hpp"

#include <array>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include "tests/message_of.hpp"

namespace hitpipe::ref::image_file_test {
namespace {

class ImageFile : public testing::Test {
 protected:
  void SetUp() override {
    const auto* const test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              fmt::format("hitpipe_image_file_{}_{}", test->name(), ::getpid());
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::ptrdiff_t files() const {
    return std::distance(std::filesystem::directory_iterator(folder_), std::filesystem::directory_iterator());
  }
  static std::string error(const std::filesystem::path& file, int width = 1, int height = 1,
                           std::size_t pixels = 1) {
    return message_of<std::exception>(
        [&] { write_image(file, width, height, std::vector<glm::vec3>(pixels)); });
  }

  std::filesystem::path folder_;
};

std::string start(const std::filesystem::path& file, std::size_t bytes) {
  std::ifstream in(file, std::ios::binary);
  std::string out(bytes, '\0');
  in.read(out.data(), static_cast<std::streamsize>(bytes));
  return out;
}

TEST_F(ImageFile, PngAndExrAppearWhole) {
  const std::vector<glm::vec3> image(6, glm::vec3(0.5F));
  write_image(folder_ / "a.png", 3, 2, image);
  write_image(folder_ / "a.EXR", 3, 2, image);
  EXPECT_EQ(start(folder_ / "a.png", 8), "\x89PNG\r\n\x1a\n");
  EXPECT_EQ(start(folder_ / "a.png", 24).substr(16),
            std::string("\0\0\0\3\0\0\0\2", 8));  // IHDR: width, height
  EXPECT_EQ(start(folder_ / "a.EXR", 4), "\x76\x2f\x31\x01");
  EXPECT_EQ(files(), 2);
}

std::vector<float> read_back(const std::filesystem::path& file) {
  const auto input = OIIO::ImageInput::open(file.string());
  std::vector<float> values(static_cast<std::size_t>(input->spec().width * input->spec().nchannels));
  input->read_scanline(0, 0, OIIO::TypeDesc::FLOAT, values.data());
  return values;
}

TEST_F(ImageFile, PngHoldsSrgbCodesAndExrLinearValues) {
  const std::vector<glm::vec3> image{{0.0F, 0.5F, 1.0F}, {0.25F, 0.002F, 2.0F}};
  write_image(folder_ / "a.exr", 2, 1, image);
  EXPECT_THAT(read_back(folder_ / "a.exr"),
              testing::Pointwise(testing::FloatNear(1e-6F), {0.0F, 0.5F, 1.0F, 0.25F, 0.002F, 2.0F}));
  write_image(folder_ / "a.png", 2, 1, {{0.0F, 0.5F, 1.0F}, {0.002F, 2.0F, NAN}});
  std::vector<float> codes = read_back(folder_ / "a.png");
  for (float& code : codes) code *= 255.0F;
  // IEC 61966-2-1: 1.055 * 0.5^(1/2.4) - 0.055 = 0.7354; 12.92 * 0.002 = 0.0258; too bright is white, NaN is
  // black.
  EXPECT_THAT(codes,
              testing::Pointwise(testing::FloatNear(1e-3F), {0.0F, 188.0F, 255.0F, 7.0F, 255.0F, 0.0F}));
}

TEST_F(ImageFile, NoTimeIsWritten) {
  write_image(folder_ / "a.exr", 1, 1, {glm::vec3(1.0F)});
  const std::string bytes = start(folder_ / "a.exr", std::filesystem::file_size(folder_ / "a.exr"));
  // OpenEXR's attribute: name, type, size; the size of the text must be 0.
  const std::string empty_date("capDate\0string\0\0\0\0\0", 19);
  EXPECT_EQ(bytes.find("capDate"), bytes.find(empty_date));
}

TEST_F(ImageFile, ExistingFileIsReplaced) {
  std::ofstream(folder_ / "a.png") << "old";
  write_image(folder_ / "a.png", 1, 1, {glm::vec3(1.0F)});
  EXPECT_EQ(start(folder_ / "a.png", 4), "\x89PNG");
  EXPECT_EQ(files(), 1);
}

TEST_F(ImageFile, BadPlacesAndNamesAreRejected) {
  EXPECT_EQ(error("picture.jpg"),
            "image file \"picture.jpg\": unknown extension \".jpg\"; allowed are .png and .exr");
  EXPECT_EQ(error("picture"), "image file \"picture\": unknown extension \"\"; allowed are .png and .exr");
  EXPECT_EQ(error("/no/such/a.png"),
            "image file \"/no/such/a.png\": no folder \"/no/such\"; create it first");
  std::filesystem::create_directories(folder_ / "d.png");
  EXPECT_EQ(error(folder_ / "d.png"), fmt::format("image file \"{}\": is a folder; give the name of a file",
                                                  (folder_ / "d.png").string()));
  EXPECT_EQ(error(folder_ / "a.png", 2, 2, 3),
            fmt::format(
                "image file \"{}\": 3 pixels do not fill 2 x 2; every pixel of an image of at least 1 x 1 is "
                "needed",
                (folder_ / "a.png").string()));
  EXPECT_EQ(files(), 1);
}

TEST_F(ImageFile, FolderThatTakesNoFilesIsRejected) {
  // Not even root can make a file in /proc.
  EXPECT_THAT(error("/proc/a.png"),
              testing::MatchesRegex("/proc(/a.png)?: cannot write (the file|to the folder): .+"));
}

TEST_F(ImageFile, FullDiskLeavesTheOldFileAndNoPart) {
  for (const char* const name : {"a.png", "a.exr"}) {
    const std::filesystem::path file = folder_ / name;
    std::ofstream(file) << "old";
    // A limit on the size of files replaces a full disk. The image is noise, so that it does not compress
    // below the limit.
    std::vector<glm::vec3> noise(256 * 256);
    unsigned state = 1;
    for (glm::vec3& colour : noise)
      for (int k = 0; k < 3; ++k)
        colour[k] = static_cast<float>((state = state * 1664525U + 1013904223U) >> 8U) / 0x1p24F;
    rlimit before{};
    ::getrlimit(RLIMIT_FSIZE, &before);
    const rlimit small{4096, before.rlim_max};
    auto* const handler = std::signal(SIGXFSZ, SIG_IGN);
    ::setrlimit(RLIMIT_FSIZE, &small);
    const std::string message = message_of<std::exception>([&] { write_image(file, 256, 256, noise); });
    ::setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
    EXPECT_EQ(message, file.string() + ": cannot write the file: File too large");
    EXPECT_EQ(start(file, 3), "old");
  }
  EXPECT_EQ(files(), 2);
}

}  // namespace
}  // namespace hitpipe::ref::image_file_test
