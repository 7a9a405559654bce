// Files appear whole or not at all; the schematic is drawn by Graphviz.
#include "rtl_gen/emit/files.hpp"

#include <algorithm>
#include <stdexcept>

#include <gtest/gtest.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/resource.h>

#include "rtl_gen/emit/manifest.hpp"
#include "rtl_gen/schematic/dot.hpp"
#include "tests/message_of.hpp"
#include "tests/rtl_gen/catalogue/formats.hpp"
#include "tests/rtl_gen/tool.hpp"

namespace hitpipe::rtl {
namespace {

/// Files below a folder, hidden ones too.
std::vector<std::string> files_in(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) names.push_back(std::filesystem::relative(entry.path(), folder).string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string told(const std::filesystem::path& folder, const std::vector<File>& files) {
  return message_of<std::runtime_error>([&] { write_files(folder, files); });
}

EmittedDesign emitted(const DesignFormat& d, const EmitOptions& options = {}) {
  return emit(d.found(), d.parsed(), Library::thesis(), d.pipeline(), options);
}

std::vector<std::string> names_of(const std::vector<File>& files) {
  std::vector<std::string> names;
  for (const File& file : files) names.push_back(file.name);
  return names;
}

TEST(Emit, NamesEveryPart) {
  const EmittedDesign d = emitted({"int_slabs", "20/24"}, {.axi_stream = true});
  EXPECT_EQ(d.verilog.name, "int_slabs.v");
  EXPECT_EQ(d.manifest.name, "int_slabs.json");
  EXPECT_EQ(d.core.name, "int_slabs.core");
  EXPECT_EQ(d.schematic.name, "int_slabs.dot");
  EXPECT_EQ(d.testbench.name, "tb/int_slabs_tb.v");
  EXPECT_EQ(d.vectors.name, "tb/int_slabs_vectors.hex");
  EXPECT_EQ(d.axi_stream.value().name, "int_slabs_axis.v");
  EXPECT_FALSE(d.check_module.has_value());
  EXPECT_EQ(names_of(d.stage_schematics),
            (std::vector<std::string>{"int_slabs_stage_1.dot", "int_slabs_stages_2-3.dot",
                                      "int_slabs_stage_4.dot"}));
}

TEST(Emit, PutsInEveryPartWhatItIs) {
  const EmittedDesign d = emitted({"int_slabs", "20/24"}, {.axi_stream = true});
  EXPECT_NE(d.verilog.contents.find("module int_slabs #("), std::string::npos);
  EXPECT_EQ(head_of(d.manifest.contents).design, "int_slabs");
  EXPECT_TRUE(d.core.contents.starts_with("CAPI=2:"));
  EXPECT_TRUE(d.schematic.contents.starts_with("digraph"));
  EXPECT_NE(d.testbench.contents.find("module int_slabs_tb;"), std::string::npos);
  EXPECT_EQ(std::count(d.vectors.contents.begin(), d.vectors.contents.end(), '\n'), 1000);
  EXPECT_NE(d.axi_stream.value().contents.find("module int_slabs_axis #("), std::string::npos);
}

TEST(Emit, GivesTheStageSchematicsOfAFloatDesign) {
  EXPECT_EQ(names_of(emitted({"fp_slabs", "fp32"}).stage_schematics),
            (std::vector<std::string>{"fp_slabs_stages_1-7.dot", "fp_slabs_stages_8-12.dot",
                                      "fp_slabs_stage_13.dot"}));
}

TEST(Emit, FilesAreAllPartsEachOnce) {
  EXPECT_EQ(names_of(emitted({"int_slabs", "20/24"}, {.axi_stream = true}).files()),
            (std::vector<std::string>{"int_slabs.v", "int_slabs.json", "int_slabs.core", "int_slabs.dot",
                                      "tb/int_slabs_tb.v", "tb/int_slabs_vectors.hex", "int_slabs_axis.v",
                                      "int_slabs_stage_1.dot", "int_slabs_stages_2-3.dot",
                                      "int_slabs_stage_4.dot"}));
}

TEST(Emit, AddsTheWrapperOnlyWhenAsked) {
  for (const DesignFormat& d : every_design({"20/24"})) {
    const EmittedDesign with = emitted(d, {.axi_stream = true});
    const EmittedDesign without = emitted(d);
    EXPECT_FALSE(without.axi_stream.has_value()) << d;
    ASSERT_TRUE(with.axi_stream.has_value()) << d;
    std::vector<std::string> names = names_of(with.files());
    std::erase(names, d.design + "_axis.v");
    EXPECT_EQ(names, names_of(without.files())) << d;
    EXPECT_EQ(with.verilog.contents, without.verilog.contents) << d;
  }
}

TEST(Emit, DrawsEveryGroupOfStagesOnce) {
  for (const DesignFormat& d : every_design({"20/24", "24/24"})) {
    const EmittedDesign made = emitted(d);
    const std::size_t groups = stage_groups(d.pipeline()).size();
    EXPECT_EQ(made.stage_schematics.size(), groups > 1 ? groups : 0) << d;
    EXPECT_EQ(made.schematics().size(), 1 + made.stage_schematics.size()) << d;
    EXPECT_EQ(made.schematics().front().contents, made.schematic.contents) << d;
  }
}

TEST(Emit, FilesAndDrawingsHaveADrawingOfEverySchematic) {
  const EmittedDesign made = emitted({"int_slabs", "20/24"});
  std::vector<std::string> expected = names_of(made.files());
  expected.insert(expected.end(), {"int_slabs.svg", "int_slabs_stage_1.svg", "int_slabs_stages_2-3.svg",
                                   "int_slabs_stage_4.svg"});
  EXPECT_EQ(names_of(files_and_drawings(made)), expected);
}

TEST(WriteFiles, CreatesFoldersAndReplacesFiles) {
  const ScratchFolder folder;
  const std::filesystem::path out = folder / "new" / "out";
  write_files(out, {{"a.v", "first\n"}, {"tb/b.v", "second\n"}});
  EXPECT_EQ(files_in(folder.path()), (std::vector<std::string>{"new/out/a.v", "new/out/tb/b.v"}));
  write_files(out, {{"a.v", "third\n"}});
  EXPECT_EQ(read_text(out / "a.v"), "third\n");
  EXPECT_EQ(read_text(out / "tb" / "b.v"), "second\n");
}

TEST(WriteFiles, KeepsEveryByte) {
  const ScratchFolder folder;
  const std::string bytes("a\r\nb\0c\n", 7);
  write_files(folder.path(), {{"x", bytes}});
  EXPECT_EQ(read_text(folder / "x"), bytes);
}

TEST(WriteFiles, FolderBelowAFileRejected) {
  const ScratchFolder folder;
  write_text(folder / "file", "text");
  const std::filesystem::path out = folder / "file" / "out";
  EXPECT_EQ(told(out, {{"a.v", "x"}}), out.string() + ": cannot create the folder: Not a directory");
  EXPECT_EQ(files_in(folder.path()), std::vector<std::string>{"file"});
}

TEST(WriteFiles, NameThatCannotBeWrittenRejectedAndNothingLeftBehind) {
  const ScratchFolder folder;
  const std::string name(300, 'x');
  EXPECT_EQ(told(folder.path(), {{"a.v", "x"}, {name, "x"}}),
            (folder / name).string() + ": cannot write the file: File name too long");
  EXPECT_EQ(files_in(folder.path()), std::vector<std::string>{});
}

/// As on a full disk: the second file is cut short.
TEST(WriteFiles, FileThatIsCutShortRejectedAndNothingLeftBehind) {
  const ScratchFolder folder;
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = signal(SIGXFSZ, SIG_IGN);
  const rlimit small{10'000, before.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string message = told(folder.path(), {{"a.v", "x"}, {"b.v", std::string(20'000, 'y')}});
  EXPECT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
  signal(SIGXFSZ, handler);
  EXPECT_EQ(message, (folder / "b.v").string() + ": cannot write the file: File too large");
  EXPECT_EQ(files_in(folder.path()), std::vector<std::string>{});
}

TEST(WriteFiles, FolderInTheWayRejectedAndNothingLeftBehind) {
  const ScratchFolder folder;
  std::filesystem::create_directories(folder / "b.v" / "inside");
  EXPECT_EQ(told(folder.path(), {{"a.v", "x"}, {"b.v", "y"}, {"c.v", "z"}}),
            (folder / "b.v").string() + ": cannot write the file: Is a directory");
  EXPECT_EQ(files_in(folder.path()), std::vector<std::string>{});
}

TEST(WriteFiles, AFailureKeepsWhatWasThere) {
  const ScratchFolder folder;
  write_text(folder / "a.v", "before");
  write_text(folder / "file", "text");
  EXPECT_EQ(told(folder.path(), {{"a.v", "after"}, {"file/b.v", "x"}}),
            (folder / "file").string() + ": cannot create the folder: Not a directory");
  EXPECT_EQ(read_text(folder / "a.v"), "before");
  EXPECT_EQ(files_in(folder.path()), (std::vector<std::string>{"a.v", "file"}));
}

TEST(Draw, MakesAnSvgOfEverySchematic) {
  const auto drawings =
      draw({{"toy.dot", "digraph toy { one -> two }"}, {"toy_stage_1.dot", "digraph toy { three -> four }"}});
  ASSERT_EQ(drawings.size(), 2U);
  EXPECT_EQ(drawings[0].name, "toy.svg");
  EXPECT_NE(drawings[0].contents.find("<svg"), std::string::npos);
  EXPECT_NE(drawings[0].contents.find(">two</text>"), std::string::npos);
  EXPECT_EQ(drawings[1].name, "toy_stage_1.svg");
  EXPECT_NE(drawings[1].contents.find(">four</text>"), std::string::npos);
}

TEST(Draw, NothingToDrawGivesNothing) {
  EXPECT_TRUE(draw({}).empty());
}

TEST(Draw, TextThatIsNoGraphRejected) {
  EXPECT_EQ(message_of<std::runtime_error>([] {
              static_cast<void>(draw({{"toy.dot", "digraph {"}}));
            }),
            "toy.dot: Graphviz's dot failed; install the package graphviz");
}

TEST(Draw, MissingGraphvizRejected) {
  const std::string path = getenv("PATH");
  setenv("PATH", "/nowhere", 1);
  const std::string message = message_of<std::runtime_error>([] {
    static_cast<void>(draw({{"toy.dot", "digraph {}"}}));
  });
  setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(message, "toy.dot: Graphviz's dot was not found; install the package graphviz");
}

}  // namespace
}  // namespace hitpipe::rtl
