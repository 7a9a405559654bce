// Files appear whole or not at all; the schematic is drawn by Graphviz.
#include "rtl_gen/emit/files.hpp"

#include <algorithm>
#include <stdexcept>

#include <gtest/gtest.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/resource.h>

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
