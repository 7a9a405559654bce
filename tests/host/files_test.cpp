// Files are read whole and appear whole or not at all, and a failure names the file and the reason. Temporary
// folders exist as long as their objects.
#include "host/files.hpp"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <optional>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/message_of.hpp"
#include "tests/rtl_gen/tool.hpp"
#include "tests/sim/environment.hpp"

namespace hitpipe::host {
namespace {

using hitpipe::message_of;
using rtl::read_text;
using rtl::write_text;

/// Files below a folder, hidden files too.
std::vector<std::string> files_in(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) names.push_back(std::filesystem::relative(entry.path(), folder).string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string told(const std::filesystem::path& folder, const std::vector<File>& files) {
  return message_of<std::runtime_error>([&] { host::write_files(folder, files); });
}

TEST(ReadFile, GivesEveryByte) {
  const ScratchFolder folder;
  const std::string bytes = std::string(100'000, 'x') + std::string("\r\n\0\x1a", 4);
  write_file(folder / "file", bytes);
  EXPECT_EQ(read_file(folder / "file"), bytes);
  EXPECT_EQ(contents_of(folder / "file"), bytes);
  write_file(folder / "empty", "");
  EXPECT_EQ(read_file(folder / "empty"), "");
}

TEST(ReadFile, ComplainsInTheCallersWords) {
  const ScratchFolder folder;
  for (const std::filesystem::path& file : {folder / "none", folder.path()}) {
    EXPECT_EQ(contents_of(file), std::nullopt);
    EXPECT_EQ(message_of<std::runtime_error>([&] { (void)read_file(file); }),
              file.string() + ": cannot read the file");
    EXPECT_EQ(message_of<std::runtime_error>([&] { (void)read_file(file, "is no library"); }),
              file.string() + ": is no library");
  }
}

TEST(WriteFiles, CreatesFoldersAndReplacesFiles) {
  const ScratchFolder folder;
  const std::filesystem::path out = folder / "new" / "out";
  host::write_files(out, {{"a.v", "first\n"}, {"tb/b.v", "second\n"}});
  EXPECT_EQ(files_in(folder.path()), (std::vector<std::string>{"new/out/a.v", "new/out/tb/b.v"}));
  host::write_files(out, {{"a.v", "third\n"}});
  EXPECT_EQ(read_text(out / "a.v"), "third\n");
  EXPECT_EQ(read_text(out / "tb" / "b.v"), "second\n");
}

TEST(WriteFiles, ScriptIsAProgram) {
  const ScratchFolder folder;
  host::write_files(folder.path(), {{"script", "#!/bin/sh\n"}, {"text", "echo #!/bin/sh\n"}});
  const auto may = [&](const char* name, int right) { return access((folder / name).c_str(), right) == 0; };
  EXPECT_TRUE(may("script", R_OK | X_OK));
  EXPECT_FALSE(may("text", X_OK));
  host::write_file(folder / "alone", "#!/bin/sh\n");
  EXPECT_TRUE(may("alone", X_OK));
}

TEST(WriteFiles, KeepsEveryByte) {
  const ScratchFolder folder;
  const std::string bytes("a\r\nb\0c\n", 7);
  host::write_files(folder.path(), {{"x", bytes}});
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
  const std::string long_name(300, 'x');
  EXPECT_EQ(told(folder.path(), {{"a.v", "x"}, {long_name, "x"}}),
            (folder / long_name).string() + ": cannot write the file: File name too long");
  EXPECT_EQ(files_in(folder.path()), std::vector<std::string>{});
}

/// As on a full disk: the second file is cut short.
TEST(WriteFiles, FileThatIsCutShortRejectedAndNothingLeftBehind) {
  const ScratchFolder folder;
  write_text(folder / "b.v", "before");
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = signal(SIGXFSZ, SIG_IGN);
  const rlimit small{10'000, before.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string message = told(folder.path(), {{"a.v", "x"}, {"b.v", std::string(20'000, 'y')}});
  EXPECT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
  signal(SIGXFSZ, handler);
  EXPECT_EQ(message, (folder / "b.v").string() + ": cannot write the file: File too large");
  EXPECT_EQ(files_in(folder.path()), std::vector<std::string>{"b.v"});
  EXPECT_EQ(read_text(folder / "b.v"), "before");
}

TEST(AppendToFile, WritesBehindTheEndOrNothing) {
  const ScratchFolder folder;
  const std::filesystem::path file = folder / "a.csv";
  EXPECT_EQ(message_of<std::runtime_error>([&] { append_to_file(file, "x"); }),
            file.string() + ": cannot write the file: No such file or directory");
  write_text(file, "one\n");
  append_to_file(file, "two\n");
  EXPECT_EQ(read_text(file), "one\ntwo\n");
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = signal(SIGXFSZ, SIG_IGN);
  const rlimit small{10, before.rlim_max};  // a part of the line fits
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string message = message_of<std::runtime_error>([&] { append_to_file(file, "three\n"); });
  EXPECT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
  signal(SIGXFSZ, handler);
  EXPECT_EQ(message, file.string() + ": cannot write the file: File too large");
  EXPECT_EQ(read_text(file), "one\ntwo\n");
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

TEST(WriteFile, TakesANameWithoutAFolder) {
  const ScratchFolder folder;
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  write_file("it's a name", "text");
  std::filesystem::current_path(before);
  EXPECT_EQ(read_text(folder / "it's a name"), "text");
  EXPECT_EQ(files_in(folder.path()), std::vector<std::string>{"it's a name"});
}

/// The superuser could rename over /dev/null too.
TEST(WriteFile, PipesAndDevicesAreNotReplaced) {
  const ScratchFolder folder;
  const std::filesystem::path pipe = folder / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(message_of<std::runtime_error>([&] { write_file(pipe, "text"); }),
            pipe.string() + ": is not a file that can be replaced");
  EXPECT_TRUE(std::filesystem::is_fifo(pipe));
}

/// /proc accepts no files, not even from the superuser.
TEST(WriteFile, FolderThatTakesNoFilesRejected) {
  EXPECT_THAT(message_of<std::runtime_error>([] { write_file("/proc/a", "text"); }),
              testing::MatchesRegex("/proc(/a: cannot write the file|: cannot write to the folder): .+"));
}

TEST(WriteFile, UnwritableFolderRejected) {
  const ScratchFolder folder;
  std::filesystem::permissions(folder.path(), std::filesystem::perms::owner_read);
  const uid_t user = getuid();
  // The superuser may write anywhere, so this part runs as nobody.
  if (user == 0) {
    ASSERT_EQ(setreuid(65534, static_cast<uid_t>(-1)), 0);
  }
  const std::string message = message_of<std::runtime_error>([&] { write_file(folder / "a.csv", "text"); });
  if (user == 0) {
    ASSERT_EQ(setreuid(0, static_cast<uid_t>(-1)), 0);
  }
  EXPECT_EQ(message, folder.path().string() + ": cannot write to the folder: Permission denied");
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(PendingFile, AppearsOnlyWhenItIsRenamed) {
  const ScratchFolder folder;
  write_text(folder / "a.csv", "before");
  {
    PendingFile file(folder / "a.csv");
    file.write("one,");
    file.write("two\n");
    file.close();
    EXPECT_EQ(read_text(folder / "a.csv"), "before");
    file.rename();
  }
  EXPECT_EQ(read_text(folder / "a.csv"), "one,two\n");
  EXPECT_EQ(files_in(folder.path()), std::vector<std::string>{"a.csv"});
}

/// Two containers may have the same process numbers and one folder.
TEST(PendingFile, OfTheSamePlaceDoNotMeet) {
  const ScratchFolder folder;
  PendingFile one(folder / "a.v");
  PendingFile other(folder / "a.v");
  EXPECT_EQ(files_in(folder.path()).size(), 2U);
  one.write("one\n");
  other.write("other\n");
  one.close();
  other.close();
  one.rename();
  EXPECT_EQ(read_text(folder / "a.v"), "one\n");
  other.rename();
  EXPECT_EQ(read_text(folder / "a.v"), "other\n");
}

/// Of a process that was killed, after it had written one file and closed another.
TEST(PendingFile, OfADeadRunIsRemovedByTheNextAndThatOfALivingOneStays) {
  const ScratchFolder folder;
  const auto start = [&] {
    const pid_t child = fork();
    if (child != 0) return child;
    PendingFile open(folder / "a.v");
    PendingFile closed(folder / "b.v");
    closed.close();
    write_text(folder / "begun", "");
    for (;;) pause();
  };
  const pid_t child = start();
  while (!std::filesystem::exists(folder / "begun")) usleep(1000);
  write_files(folder.path(), {{"a.v", "x"}, {"b.v", "x"}});
  EXPECT_EQ(files_in(folder.path()).size(), 5U) << "it lives";
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  write_files(folder.path(), {{"a.v", "x"}, {"b.v", "x"}});
  EXPECT_EQ(files_in(folder.path()), (std::vector<std::string>{"a.v", "b.v", "begun"}));
}

/// Its lock might not be seen here.
TEST(PendingFile, OfAnotherMachineStaysForADay) {
  const ScratchFolder folder;
  const std::string name = ".a.v.hitpipe-00000000-0123456789abcdef";
  for (const char* const stays : {".a.v.hitpipe-mine", ".b.v.hitpipe-00000000-0123456789abcdef", "a.v.1234"})
    write_text(folder / stays, "");
  write_text(folder / name, "");
  write_file(folder / "a.v", "");
  EXPECT_EQ(files_in(folder.path()).size(), 5U);
  using std::chrono::hours;
  for (const std::string& each : files_in(folder.path()))
    std::filesystem::last_write_time(folder / each,
                                     std::filesystem::file_time_type::clock::now() - hours(25));
  write_file(folder / "a.v", "");
  EXPECT_EQ(files_in(folder.path()).size(), 4U);
  EXPECT_FALSE(std::filesystem::exists(folder / name));
}

TEST(PendingFile, LeavesNothingWhenItIsGivenUp) {
  const ScratchFolder folder;
  PendingFile(folder / "open.csv").write("text");
  {
    PendingFile closed(folder / "closed.csv");
    closed.write("text");
    closed.close();
  }
  EXPECT_EQ(files_in(folder.path()), std::vector<std::string>{});
}

TEST(ScratchFolder, IsNewAndGoesWithAllThatIsInIt) {
  std::optional<ScratchFolder> one(std::in_place);
  const ScratchFolder other;
  const std::filesystem::path path = one->path();
  EXPECT_NE(path, other.path());
  write_file(*one / "below" / "file", "text");
  one.reset();
  EXPECT_FALSE(std::filesystem::exists(path));
  EXPECT_TRUE(std::filesystem::is_directory(other.path()));
}

TEST(ScratchFolder, OfADeadRunIsRemovedByTheNext) {
  const ScratchFolder folder;
  const auto killed = [&] {
    const pid_t child = fork();
    if (child == 0) {
      const ScratchFolder left(folder.path(), "building-");
      write_file(left / "below" / "file", "");
      kill(getpid(), SIGKILL);
    }
    waitpid(child, nullptr, 0);
  };
  killed();
  EXPECT_EQ(files_in(folder.path()).size(), 1U);
  const ScratchFolder lives(folder.path(), "building-");
  write_file(lives / "file", "");
  EXPECT_EQ(files_in(folder.path()).size(), 1U);
  const ScratchFolder next(folder.path(), "building-");
  EXPECT_TRUE(std::filesystem::exists(lives / "file"));
}

TEST(ScratchFolder, IsWhereTmpdirSays) {
  const ScratchFolder folder;
  const std::filesystem::path parent = folder / "it's a \"folder\"";
  std::filesystem::create_directory(parent);
  const sim::EnvironmentValue variable("TMPDIR", parent.string());
  const ScratchFolder inside;
  EXPECT_EQ(inside.path().parent_path(), parent);
  EXPECT_TRUE(std::filesystem::is_directory(inside.path()));
}

TEST(ScratchFolder, StaysWhereItWasMoved) {
  const ScratchFolder folder;
  {
    const ScratchFolder made(folder.path(), "building-");
    EXPECT_THAT(made.path().filename().string(), testing::MatchesRegex("building-[0-9a-f]{8}-[0-9a-f]{16}"));
    write_file(made / "file", "text");
    std::filesystem::rename(made.path(), folder / "kept");
  }
  EXPECT_TRUE(std::filesystem::exists(folder / "kept" / "file"));
}

TEST(ScratchFolder, MissingParentRejected) {
  EXPECT_EQ(message_of<std::runtime_error>([] { const ScratchFolder folder("/nonexistent", "a-"); }),
            "/nonexistent: cannot create a folder in it: No such file or directory");
}

}  // namespace
}  // namespace hitpipe::host
