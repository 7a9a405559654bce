// Environment variables name programs; programs get their words unchanged, and their end is reported.
#include "host/process.hpp"

#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/message_of.hpp"
#include "tests/sim/environment.hpp"
#include "tests/sim/temporary_folder.hpp"

namespace hitpipe::host {
namespace {

namespace fs = std::filesystem;
using sim::EnvironmentValue;
using sim::TemporaryFolder;
using testing::ElementsAre;

TEST(Run, GivesEachWordAsItIs) {
  const std::string words[] = {"two words", "it's",    "a\nline", "$HOME `id` \\ \"x\" *; exit 3",
                               "",          "\xc3\xa9"};
  std::vector<std::string> call{"printf", "%s|"};
  std::string expected;
  for (const std::string& word : words) {
    call.push_back(word);
    expected += word + "|";
  }
  const Outcome ended = run(call);
  EXPECT_TRUE(ended.succeeded());
  EXPECT_EQ(ended.out, expected);
  EXPECT_EQ(ended.err, "");
}

TEST(Run, KeepsBothStreamsApart) {
  const Outcome ended = run({"sh", "-c", "echo one; echo two >&2; echo three"});
  EXPECT_EQ(ended.out, "one\nthree\n");
  EXPECT_EQ(ended.err, "two\n");
}

/// Writes far more than a pipe holds, to both pipes at once.
TEST(Run, TakesAnyAmountOfOutput) {
  const Outcome ended =
      run({"sh", "-c",
           "head -c 1000000 /dev/zero >&2; head -c 2000000 /dev/zero; head -c 3000000 /dev/zero >&2"});
  EXPECT_EQ(ended.out, std::string(2'000'000, '\0'));
  EXPECT_EQ(ended.err, std::string(4'000'000, '\0'));
}

TEST(Run, HandsOverTheInput) {
  const std::string input = std::string(1'000'000, 'a') + "it's\n";
  EXPECT_EQ(run({"cat"}, {.input = input}).out, input);
  EXPECT_EQ(run({"cat"}).out, "") << "nobody's terminal is read";
  EXPECT_TRUE(run({"true"}, {.input = input}).succeeded()) << "a program need not read it";
}

TEST(Run, RunsInTheFolder) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "it's a folder");
  const fs::path inside = folder / "it's a folder";
  const fs::path before = fs::current_path();
  EXPECT_EQ(run({"pwd", "-P"}, {.folder = inside}).out, fs::canonical(inside).string() + "\n");
  EXPECT_EQ(fs::current_path(), before);
  EXPECT_EQ(message_of<std::runtime_error>([&] { (void)run({"true"}, {.folder = inside / "none"}); }),
            (inside / "none").string() + ": no such folder");
}

TEST(Run, FindsProgramsInPathAndByPath) {
  const TemporaryFolder folder;
  const fs::path program = folder.write_program("its own's program", "#!/bin/sh\necho \"$0: $1\"\n");
  EXPECT_EQ(run({program.string(), "a b"}).out, program.string() + ": a b\n");
  const EnvironmentValue path("PATH", folder.path().string());
  EXPECT_EQ(run({"its own's program", "a b"}).out, program.string() + ": a b\n");
}

TEST(Run, ProgramThatDoesNotExistIsNotFound) {
  for (const std::string program_name : {"hitpipe-no-such-program", "/nonexistent/program", ""}) {
    const Outcome ended = run({program_name});
    EXPECT_TRUE(ended.not_found()) << program_name;
    EXPECT_FALSE(ended.succeeded()) << program_name;
    EXPECT_EQ(ended.failure(), "was not found") << program_name;
  }
}

TEST(Run, FileThatIsNoProgramCannotBeStarted) {
  const TemporaryFolder folder;
  const Outcome ended = run({folder.write("text", "text").string()});
  EXPECT_FALSE(ended.not_found());
  EXPECT_FALSE(ended.succeeded());
  EXPECT_EQ(ended.failure(), "cannot be started: Permission denied");
}

TEST(Run, ExitCodeIsTold) {
  const Outcome ended = run({"sh", "-c", "echo said; exit 3"});
  EXPECT_EQ(ended.exit_code, 3);
  EXPECT_FALSE(ended.succeeded());
  EXPECT_FALSE(ended.not_found());
  EXPECT_EQ(ended.failure(), "failed with exit code 3");
  EXPECT_EQ(ended.out, "said\n");
  EXPECT_FALSE(run({"sh", "-c", "exit 127"}).not_found());
}

TEST(Run, SignalIsTold) {
  const Outcome ended = run({"sh", "-c", "echo said; kill -9 $$"});
  EXPECT_EQ(ended.signal, 9);
  EXPECT_FALSE(ended.succeeded());
  EXPECT_EQ(ended.failure(), "was ended by signal 9 (Killed)");
  EXPECT_EQ(ended.out, "said\n");
}

constexpr const char* variable_name = "HITPIPE_TEST_VARIABLE";

TEST(Environment, UnsetAndEmptyVariablesGiveTheOther) {
  const EnvironmentValue unset(variable_name, std::nullopt);
  EXPECT_EQ(environment(variable_name, "other"), "other");
  const EnvironmentValue empty(variable_name, "");
  EXPECT_EQ(environment(variable_name, "other"), "other");
  const EnvironmentValue set(variable_name, "it's set");
  EXPECT_EQ(environment(variable_name, "other"), "it's set");
}

TEST(ProgramOf, TakesArgumentsThatFollowTheProgram) {
  const EnvironmentValue variable(variable_name, "env LANG=C g++");
  EXPECT_THAT(program_of(variable_name, "c++"), ElementsAre("env", "LANG=C", "g++"));
}

TEST(ProgramOf, PathOfAFileIsOneWord) {
  const TemporaryFolder folder;
  const std::string program = folder.write_program("it's a compiler", "").string();
  const EnvironmentValue variable(variable_name, program);
  EXPECT_THAT(program_of(variable_name, "c++"), ElementsAre(program));
}

TEST(ProgramOf, NothingButBlanksNamesNone) {
  const EnvironmentValue blank(variable_name, " ");
  EXPECT_THAT(program_of(variable_name, "c++"), ElementsAre("c++"));
  const EnvironmentValue unset(variable_name, std::nullopt);
  EXPECT_THAT(program_of(variable_name, "c++"), ElementsAre("c++"));
}

}  // namespace
}  // namespace hitpipe::host
