// The harness of a core: its files are those of the tree, and compile without a warning around cores of all kinds.
#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rtl_gen/core/axi.hpp"
#include "rtl_gen/core/c_header.hpp"
#include "rtl_gen/core/feature.hpp"
#include "rtl_gen/core/system.hpp"
#include "tests/rtl_gen/tool.hpp"

namespace hitpipe::rtl::harness_test {
namespace {

CoreOptions small(CoreOptions options) {
  options.bits = parse_bits<hls::RayBits>("8+0/4s8");
  options.rays = 4;
  return options;
}

TEST(CoreHarness, HasTheFilesOfTheTree) {
  std::map<std::string, std::string> expected;
  for (const auto& file : std::filesystem::directory_iterator(HITPIPE_SOURCE "/rtl_gen/core/harness"))
    expected["tb/mine_axi_harness/" + file.path().filename().string()] = read_text(file.path());
  std::map<std::string, std::string> written;
  for (const host::File& file : system_program(make_core(small({}), Library::thesis(), "mine")))
    written[file.name] = file.contents;
  EXPECT_EQ(written.erase("tb/mine_axi_harness/core.hpp"), 1U);
  EXPECT_EQ(written.erase("tb/mine_axi_harness/features.hpp"), 1U);
  EXPECT_EQ(written, expected);
}

// What differs from core to core is in the file of a feature, and no file asks which core it is in.
TEST(CoreHarness, HasAFileOfEachFeatureThatNamesOne) {
  std::map<std::string, std::string> files;
  for (const host::File& file : system_program(make_core(small({}), Library::thesis(), "mine"))) {
    EXPECT_THAT(file.contents, testing::Not(testing::HasSubstr("\n#if"))) << file.name;
    files[file.name] = file.contents;
  }
  const std::string& features = files.at("tb/mine_axi_harness/features.hpp");
  for (const Feature* const each : all_features()) {
    for (const std::string_view name : {each->harness, each->harness_otherwise}) {
      if (name.empty()) continue;
      EXPECT_TRUE(files.contains(fmt::format("tb/mine_axi_harness/{}.hpp", name))) << name;
      // A core of the base alone has what stands in.
      EXPECT_EQ(features.find(fmt::format("\"{}.hpp\"", name)) != std::string::npos,
                name == each->harness_otherwise)
          << name;
    }
  }
}

struct Kind {
  const char* name;
  CoreOptions options;
};

class HarnessOf : public testing::TestWithParam<Kind> {};

TEST_P(HarnessOf, CompilesWithoutAWarning) {
  const host::ScratchFolder folder("core-harness");
  const Core core = make_core(small(GetParam().options), Library::thesis(), "core");
  host::write_files(folder.path(), system_program(core));
  host::write_files(folder.path(), {{"core.v", to_verilog(core, Library::thesis())},
                                    {"core_axi.v", axi_verilog(core)},
                                    {"core.h", c_header(core)}});
  const ToolResult verilated = run_tool(folder.path(), "verilator", "verilator",
                                        "--cc -Mdir verilated --top-module core_axi core_axi.v");
  ASSERT_EQ(verilated.status, 0) << verilated.output;
  expect_silence(folder.path(), "g++",
                 "-std=c++17 -fsyntax-only -Wall -Wextra -Wconversion -Wsign-conversion -Wshadow -Werror -I. "
                 "-isystem $(verilator --getenv VERILATOR_ROOT)/include -isystem verilated "
                 "tb/core_axi_harness/harness.cpp");
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, HarnessOf,
    testing::Values(Kind{"Default", {}}, Kind{"RingsAndFloats", {.float_door = true, .rings = true}},
                    Kind{"CacheAndWeights", {.cache = {.kib = 2}, .weights = true}},
                    Kind{"QuestionsAndOneIdentifier", {.in_order = true, .questions = true}}),
    [](const auto& each) { return each.param.name; });

}  // namespace
}  // namespace hitpipe::rtl::harness_test
