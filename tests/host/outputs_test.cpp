// Inputs are kept, no two outputs have one place, and what cannot be written is known before the work.
#include "host/outputs.hpp"

#include <filesystem>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

#include "host/files.hpp"
#include "tests/message_of.hpp"
#include "tests/rtl_gen/tool.hpp"

namespace hitpipe::host::outputs_test {
namespace {

namespace fs = std::filesystem;
using hitpipe::message_of;
using rtl::read_text;
using rtl::write_text;

/// A folder of its own for each test. None goes before the end, because a new file may get the number of one
/// that is gone.
class Files {
 public:
  explicit Files(const char* name) : path_(all() / name) { fs::create_directory(path_); }
  [[nodiscard]] const fs::path& path() const { return path_; }
  [[nodiscard]] fs::path operator/(const std::string& name) const { return path_ / name; }

 private:
  static const ScratchFolder& all() {
    static const ScratchFolder folder;
    return folder;
  }
  fs::path path_;
};

std::string told(const std::string& option, const fs::path& file) {
  try {
    announce_output(option, file);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

std::string lost(const fs::path& output) {
  return output.string() + ": is an input, which would be lost; give another file to write";
}

/// Whatever name leads to it.
TEST(Inputs, AreNotReplaced) {
  const Files folder("inputs");
  write_text(folder / "in.csv", "input");
  std::filesystem::create_symlink("in.csv", folder / "link.csv");
  std::filesystem::create_hard_link(folder / "in.csv", folder / "hard.csv");
  never_replace(folder / "link.csv");
  never_replace(folder / "none.csv");
  for (const char* const name : {"in.csv", "link.csv", "hard.csv"})
    EXPECT_EQ(message_of<std::runtime_error>([&] { write_file(folder / name, "x"); }), lost(folder / name));
  EXPECT_EQ(read_text(folder / "in.csv"), "input");
  write_file(folder / "none.csv", "x");
}

TEST(Outputs, AreNoInputs) {
  const Files folder("early");
  write_text(folder / "early.csv", "");
  write_text(folder / "late.csv", "");
  fs::create_symlink("late.csv", folder / "link.csv");
  never_replace(folder / "early.csv");
  EXPECT_EQ(told("--out", folder / "early.csv"), lost(folder / "early.csv"));
  EXPECT_EQ(told("--out", folder / "link.csv"), "");
  EXPECT_EQ(message_of<std::runtime_error>([&] { never_replace(folder / "late.csv"); }),
            lost(folder / "link.csv"));
}

/// Whatever names lead to it, and whether it is there or not.
TEST(Outputs, OfTwoOptionsHaveTwoPlaces) {
  const Files folder("two");
  write_text(folder / "a.png", "");
  fs::create_symlink("a.png", folder / "link.png");
  fs::create_hard_link(folder / "a.png", folder / "hard.png");
  fs::create_directory(folder / "b");
  fs::create_directory_symlink("b", folder / "c");
  EXPECT_EQ(told("--one", folder / "a.png"), "");
  EXPECT_EQ(told("--one", folder / "a.png"), "");
  EXPECT_EQ(told("--one", folder / "b/new.png"), "");
  EXPECT_EQ(told("--one", folder / "d/e/new.png"), "");
  for (const char* const name :
       {"a.png", "./a.png", "b/../a.png", "link.png", "hard.png", "c/new.png", "d/../d/e/new.png"})
    EXPECT_EQ(told("--two", folder / name),
              (folder / name).string() + ": is the file of --one and of --two; give each a file of its own");
  EXPECT_EQ(told("--two", folder / "new.png"), "");
  EXPECT_FALSE(fs::exists(folder / "d")) << "nothing is made";
}

/// Everybody may write to standard output.
TEST(Outputs, MayBeStandardOutput) {
  EXPECT_EQ(told("--one", "-"), "");
  EXPECT_EQ(told("--two", "-"), "");
}

TEST(Outputs, ThatCannotBeWrittenAreRefused) {
  const Files folder("refused");
  write_text(folder / "file", "");
  EXPECT_EQ(told("--out", folder.path()), folder.path().string() + ": cannot write the file: Is a directory");
  for (const char* const below : {"file", "file/below"})
    EXPECT_EQ(told("--out", (folder / below) / "a.csv"),
              (folder / below).string() + ": cannot create the folder: Not a directory");
  EXPECT_EQ(told("--out", "/dev/null"), "/dev/null: is not a file that can be replaced");
  const fs::path long_name = folder / std::string(300, 'x');
  EXPECT_EQ(told("--out", long_name), long_name.string() + ": cannot write the file: File name too long");
}

TEST(Outputs, OfAnUnwritableFolderAreRefused) {
  const Files folder("unwritable");
  fs::permissions(folder.path(), fs::perms::owner_read | fs::perms::owner_exec);
  const uid_t user = getuid();
  // The superuser may write anywhere. access() asks for the real user.
  if (user == 0) {
    ASSERT_EQ(setreuid(65534, static_cast<uid_t>(-1)), 0);
  }
  const std::string here = told("--out", folder / "a.csv");
  const std::string below = told("--out", folder / "new/a.csv");
  if (user == 0) {
    ASSERT_EQ(setreuid(0, static_cast<uid_t>(-1)), 0);
  }
  EXPECT_EQ(here, folder.path().string() + ": cannot write to the folder: Permission denied");
  EXPECT_EQ(below, (folder / "new").string() + ": cannot create the folder: Permission denied");
}

}  // namespace
}  // namespace hitpipe::host::outputs_test
