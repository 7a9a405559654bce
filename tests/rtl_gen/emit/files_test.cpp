// Which files a design is; its schematics are drawn by Graphviz.
#include "rtl_gen/emit/files.hpp"

#include <algorithm>
#include <stdexcept>

#include <gtest/gtest.h>

#include "rtl_gen/schematic/dot.hpp"
#include "tests/rtl_gen/catalogue/formats.hpp"
#include "tests/rtl_gen/message_of.hpp"
#include "tests/rtl_gen/tool.hpp"
#include "tests/sim/environment.hpp"

namespace hitpipe::rtl {
namespace {

std::vector<std::string> emitted_names(const DesignFormat& d, const EmitOptions& options = {}) {
  std::vector<std::string> names;
  for (const File& file : emit(d.found(), d.parsed(), Library::thesis(), d.pipeline(), options))
    names.push_back(file.name);
  return names;
}

TEST(Emit, GivesTheFilesOfADesign) {
  EXPECT_EQ(
      emitted_names({"int_slabs", "20/24"}),
      (std::vector<std::string>{"int_slabs.v", "int_slabs.json", "int_slabs.core", "int_slabs.dot",
                                "tb/int_slabs_tb.v", "tb/int_slabs_vectors.hex", "int_slabs_stage_1.dot",
                                "int_slabs_stages_2-3.dot", "int_slabs_stage_4.dot"}));
}

TEST(Emit, GivesTheFilesOfAFloatDesign) {
  EXPECT_EQ(
      emitted_names({"fp_slabs", "fp32"}),
      (std::vector<std::string>{"fp_slabs.v", "fp_slabs.json", "fp_slabs.core", "fp_slabs.dot",
                                "tb/fp_slabs_tb.v", "tb/fp_slabs_vectors.hex", "fp_slabs_stages_1-7.dot",
                                "fp_slabs_stages_8-12.dot", "fp_slabs_stage_13.dot"}));
}

TEST(Emit, AddsTheWrapperOnlyWhenAsked) {
  for (const DesignFormat& d : every_design({"20/24"})) {
    std::vector<std::string> names = emitted_names(d, {.axi_stream = true});
    const auto wrapper = std::find(names.begin(), names.end(), d.design + "_axis.v");
    ASSERT_NE(wrapper, names.end()) << d;
    names.erase(wrapper);
    EXPECT_EQ(names, emitted_names(d)) << d;
  }
}

TEST(Emit, DrawsEveryGroupOfStagesOnce) {
  for (const DesignFormat& d : every_design({"20/24", "24/24"})) {
    const Pipeline pipeline = d.pipeline();
    const auto files = emit(d.found(), d.parsed(), Library::thesis(), pipeline);
    const auto drawings = std::count_if(files.begin(), files.end(),
                                        [](const File& file) { return file.name.ends_with(".dot"); });
    const std::size_t groups = stage_groups(pipeline).size();
    EXPECT_EQ(static_cast<std::size_t>(drawings), 1 + (groups > 1 ? groups : 0)) << d;
  }
}

TEST(Draw, MakesAnSvgOfEverySchematic) {
  const auto drawings = draw({{"toy.v", ""},
                              {"toy.dot", "digraph toy { one -> two }"},
                              {"toy_stage_1.dot", "digraph toy { three -> four }"}});
  ASSERT_EQ(drawings.size(), 2U);
  EXPECT_EQ(drawings[0].name, "toy.svg");
  EXPECT_NE(drawings[0].contents.find("<svg"), std::string::npos);
  EXPECT_NE(drawings[0].contents.find(">two</text>"), std::string::npos);
  EXPECT_EQ(drawings[1].name, "toy_stage_1.svg");
  EXPECT_NE(drawings[1].contents.find(">four</text>"), std::string::npos);
}

TEST(Draw, NothingToDrawGivesNothing) {
  EXPECT_TRUE(draw({{"toy.v", ""}}).empty());
}

TEST(Draw, TextThatIsNoGraphRejected) {
  EXPECT_EQ(message_of<std::runtime_error>([] {
              static_cast<void>(draw({{"toy.dot", "digraph {"}}));
            }),
            "toy.dot: Graphviz's dot failed with exit code 1");
}

TEST(Draw, TakesAnyTemporaryFolder) {
  const ScratchFolder folder;
  const std::filesystem::path temporary = folder / "it's temporary";
  std::filesystem::create_directory(temporary);
  const sim::EnvironmentValue variable("TMPDIR", temporary.string());
  EXPECT_NE(draw({{"toy.dot", "digraph toy { one }"}}).front().contents.find(">one</text>"),
            std::string::npos);
  EXPECT_TRUE(std::filesystem::is_empty(temporary));
}

TEST(Draw, MissingGraphvizRejected) {
  const sim::EnvironmentValue path("PATH", "/nowhere");
  EXPECT_EQ(message_of<std::runtime_error>([] {
              static_cast<void>(draw({{"toy.dot", "digraph {}"}}));
            }),
            "toy.dot: Graphviz's dot was not found; install the package graphviz");
}

}  // namespace
}  // namespace hitpipe::rtl
