// Files appear whole or not at all; the schematic is drawn by Graphviz.
#include "rtl_gen/emit/files.hpp"

#include <stdexcept>

#include <gtest/gtest.h>
#include <stdlib.h>

#include "tests/rtl_gen/catalogue/formats.hpp"
#include "tests/rtl_gen/message_of.hpp"
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

TEST(Emit, GivesTheFilesOfADesign) {
  const auto files =
      emit(find_design("int_slabs"), {20, 24}, Library::thesis(), int_slabs_pipeline({20, 24}));
  std::vector<std::string> names;
  for (const File& file : files) names.push_back(file.name);
  EXPECT_EQ(names, (std::vector<std::string>{"int_slabs.v", "int_slabs.json", "int_slabs.dot",
                                             "tb/int_slabs_tb.v", "tb/int_slabs_vectors.hex"}));
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
            (folder / name).string() + ": cannot write the file");
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

TEST(Draw, MakesAnSvgOfTheSchematic) {
  const File svg = draw({{"toy.v", ""}, {"toy.dot", "digraph toy { one -> two }"}});
  EXPECT_EQ(svg.name, "toy.svg");
  EXPECT_NE(svg.contents.find("<svg"), std::string::npos);
  EXPECT_NE(svg.contents.find(">two</text>"), std::string::npos);
}

TEST(Draw, NoSchematicRejected) {
  EXPECT_EQ(message_of<std::invalid_argument>([] {
              static_cast<void>(draw({{"toy.v", ""}}));
            }),
            "there is no schematic among the files");
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
