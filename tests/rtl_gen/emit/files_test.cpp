// The files of a design. Graphviz draws its schematics.
#include "rtl_gen/emit/files.hpp"

#include <algorithm>
#include <filesystem>
#include <regex>
#include <sstream>
#include <stdexcept>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "host/text.hpp"
#include "rtl_gen/emit/manifest.hpp"
#include "rtl_gen/schematic/dot.hpp"
#include "rtl_gen/verilog/names.hpp"
#include "tests/message_of.hpp"
#include "tests/rtl_gen/catalogue/formats.hpp"
#include "tests/rtl_gen/tool.hpp"
#include "tests/sim/environment.hpp"

namespace hitpipe::rtl::files_test {
namespace {

std::vector<std::string> names_of(const std::vector<File>& files) {
  std::vector<std::string> names;
  for (const File& file : files) names.push_back(file.name);
  return names;
}

TEST(Emit, PutsInEveryPartWhatItIs) {
  const EmittedDesign d = DesignFormat{"int_slabs", "20/24"}.emitted({.axi_stream = true});
  EXPECT_NE(d.verilog.contents.find("module int_slabs #("), std::string::npos);
  EXPECT_EQ(head_of(d.manifest->dump()).design, "int_slabs");
  EXPECT_TRUE(d.core.contents.starts_with("CAPI=2:"));
  for (const File& each : d.schematics) EXPECT_TRUE(each.contents.starts_with("digraph"));
  EXPECT_NE(d.testbench.contents.find("module int_slabs_tb;"), std::string::npos);
  EXPECT_NE(d.harness.contents.find("#include \"Vint_slabs.h\""), std::string::npos);
  EXPECT_NE(d.makefile.contents.find("harness:"), std::string::npos);
  std::istringstream vectors(d.vectors.contents);
  int vector_lines = 0;
  for (std::string line; std::getline(vectors, line);) vector_lines += line.starts_with("//") ? 0 : 1;
  EXPECT_EQ(vector_lines, 1000);
  EXPECT_NE(d.axi_stream.value().contents.find("module int_slabs_axis #("), std::string::npos);
}

TEST(Emit, FilesAreAllPartsEachOnce) {
  EXPECT_EQ(names_of(DesignFormat{"int_slabs", "20/24"}.emitted({.axi_stream = true}).files()),
            (std::vector<std::string>{"int_slabs.v", "int_slabs.json", "int_slabs.core", "tb/int_slabs_tb.sv",
                                      "tb/int_slabs_harness.cpp", "tb/Makefile", "tb/int_slabs_vectors.hex",
                                      "tb/int_slabs_axis_tb.sv", "int_slabs_axis.v", "int_slabs_stage_1.dot",
                                      "int_slabs_stages_2-3.dot", "int_slabs_stage_4.dot"}));
}

TEST(Emit, AddsTheTopFunctionOnlyWhenAsked) {
  for (const DesignFormat& d : every_design({"20/24"})) {
    if (find_design(d.design).source.pipeline.empty()) continue;  // it does not say where its C++ is
    const EmittedDesign with = d.emitted({.hls = true});
    EXPECT_EQ(
        names_of(with.hls),
        (std::vector<std::string>{"hls/" + d.module() + ".hpp", "hls/" + d.module() + ".cpp",
                                  "hls/" + d.module() + "_csim.cpp", "hls/" + d.module() + "_vitis_hls.tcl",
                                  "hls/" + d.module() + "_hls.cfg", "hls/" + d.module() + "_catapult.tcl",
                                  "hls/" + d.module() + "_bambu.sh"}))
        << d;
    std::vector<std::string> names = names_of(with.files());
    std::erase_if(names, [](const std::string& name) { return name.starts_with("hls/"); });
    EXPECT_EQ(names, names_of(d.emitted().files())) << d;
  }
}

TEST(Emit, DrawsEveryGroupOfStagesOnce) {
  for (const DesignFormat& d : every_design({"20/24", "24/24"}))
    EXPECT_EQ(d.emitted().schematics.size(), stage_groups(d.pipeline()).size()) << d;
}

TEST(Emit, NamesEverythingAfterTheModule) {
  const DesignFormat d{"int_slabs", "16/16"};
  for (const std::string module : {"", "box_test"}) {
    const std::string name = module.empty() ? "int_slabs_16_16" : module;
    const EmittedDesign unit = d.emitted({.axi_stream = true, .hls = true}, {.module = module});
    EXPECT_EQ(unit.module, name);
    const std::regex defined("\nmodule ([a-z0-9_]+)");
    for (const File& file : unit.files()) {
      if (file.name == unit.makefile.name) continue;  // it serves all units of the folder
      EXPECT_TRUE(std::filesystem::path(file.name).filename().string().starts_with(name)) << file.name;
      for (std::sregex_iterator at(file.contents.begin(), file.contents.end(), defined);
           at != std::sregex_iterator(); ++at)
        EXPECT_TRUE((*at)[1].str().starts_with(name)) << file.name << " " << (*at)[1];
    }
    EXPECT_EQ(head_of(unit.manifest->dump()).module, name);
    EXPECT_EQ(head_of(unit.manifest->dump()).design, "int_slabs");
  }
}

TEST(Emit, NameThatIsNoneRejected) {
  const auto message = [](const std::string& name) { return message_of([&] { check_module_name(name); }); };
  for (const char* const name : {"a", "x1", "Box_Test_2"}) EXPECT_NO_THROW(check_module_name(name)) << name;
  for (const std::string& name :
       {std::string(), std::string("2a"), std::string("_a"), std::string("a_"), std::string("a__b"),
        std::string("a b"), std::string("a$"), std::string("../a"), std::string(129, 'a')})
    EXPECT_EQ(message(name), "name " + host::shortened(name) +
                                 ": allowed are letters, digits and single underscores between them, with a "
                                 "letter first, at most 128 characters");
  EXPECT_EQ(message("module"), "name module: is a keyword of Verilog; take another");
  EXPECT_EQ(message("logic"), "name logic: is a keyword of Verilog; take another");
  EXPECT_EQ(message("co_await"), "name co_await: is a keyword of C++; take another");
  EXPECT_EQ(message_of([] {
              return DesignFormat{"int_slabs", "20/24"}.emitted({}, {.module = "wire"});
            }),
            "name wire: is a keyword of Verilog; take another");
}

TEST(Draw, MakesAnSvgOfEverySchematic) {
  const auto drawings =
      draw({{"toy.dot", "digraph toy { one -> two }"}, {"toy_stage_1.dot", "digraph toy { three -> four }"}})
          .value();
  ASSERT_EQ(drawings.size(), 2U);
  EXPECT_EQ(drawings[0].name, "toy.svg");
  EXPECT_NE(drawings[0].contents.find("<svg"), std::string::npos);
  EXPECT_NE(drawings[0].contents.find(">two</text>"), std::string::npos);
  EXPECT_EQ(drawings[1].name, "toy_stage_1.svg");
  EXPECT_NE(drawings[1].contents.find(">four</text>"), std::string::npos);
}

TEST(Draw, NothingToDrawGivesNothing) {
  EXPECT_TRUE(draw({}).value().empty());
}

TEST(Draw, TextThatIsNoGraphRejected) {
  EXPECT_EQ(message_of([] {
              return draw({{"toy.dot", "digraph {"}});
            }),
            "toy.dot: Graphviz's dot failed with exit code 1");
}

TEST(Draw, TakesAnyTemporaryFolder) {
  const ScratchFolder folder;
  const std::filesystem::path temporary = folder / "it's temporary";
  std::filesystem::create_directory(temporary);
  const sim::EnvironmentValue variable("TMPDIR", temporary.string());
  EXPECT_NE(draw({{"toy.dot", "digraph toy { one }"}}).value().front().contents.find(">one</text>"),
            std::string::npos);
  EXPECT_TRUE(std::filesystem::is_empty(temporary));
}

TEST(Draw, NothingIsDrawnWithoutGraphviz) {
  const sim::EnvironmentValue path("PATH", "/nowhere");
  EXPECT_FALSE(draw({{"toy.dot", "digraph {}"}}).has_value());
}

}  // namespace
}  // namespace hitpipe::rtl::files_test
