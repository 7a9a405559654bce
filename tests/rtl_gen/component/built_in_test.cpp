// The libraries of the program: each file is there by its name.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rtl_gen/component/library.hpp"
#include "tests/message_of.hpp"
#include "tests/rtl_gen/component/unit_library.hpp"

namespace hitpipe::rtl::built_in_test {
namespace {

TEST(BuiltIn, EveryFileOfTheFolderIsThere) {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(HITPIPE_SOURCE) /
                                                               "rtl_gen/component/libraries")) {
    EXPECT_EQ(entry.path().extension(), ".json");
    files.push_back(entry.path().stem().string());
  }
  std::sort(files.begin(), files.end());
  EXPECT_EQ(built_in_names(), files);
  EXPECT_THAT(files, testing::IsSupersetOf({"ecp5", "ice40_hx", "ice40_up5k", "thesis_250nm", "xc7"}));
}

TEST(BuiltIn, EachCallsItselfAsItsFileAndSaysWhereItIsFrom) {
  for (const std::string& name : built_in_names()) {
    EXPECT_EQ(library_called(name).name(), name);
    EXPECT_NE(library_called(name).source(), "") << name;
  }
  EXPECT_EQ(Library::thesis().name(), default_library);
}

TEST(BuiltIn, ChipsHaveNoFloatsOfTheirOwn) {
  const Library xilinx = library_called("xc7");
  EXPECT_TRUE(xilinx.has(Component::int_multiply));
  EXPECT_FALSE(library_called("ice40_hx").has(Component::int_multiply));
  EXPECT_FALSE(xilinx.has(Component::fp_multiply));
  EXPECT_EQ(
      message_of<std::runtime_error>([&] { static_cast<void>(xilinx.timing(Component::fp_multiply, 32)); }),
      "library xc7: it has no fp_multiply");
}

TEST(BuiltIn, UnknownNameRejected) {
  const std::string message =
      message_of<std::runtime_error>([] { static_cast<void>(library_called("virtex")); });
  EXPECT_THAT(message, testing::StartsWith("library virtex: unknown; there are ecp5, ice40_hx, "));
  EXPECT_THAT(message, testing::EndsWith(", xc7, and any file whose name ends in .json"));
}

TEST(BuiltIn, AFileIsCalledByItsPath) {
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "hitpipe_xc7.json";
  std::ofstream(file) << unit_json;
  EXPECT_EQ(library_called(file.string()).name(), "unit");
  std::filesystem::remove(file);
  EXPECT_EQ(message_of<std::runtime_error>([&] { static_cast<void>(library_called(file.string())); }),
            file.string() + ": cannot read the component library");
}

}  // namespace
}  // namespace hitpipe::rtl::built_in_test
