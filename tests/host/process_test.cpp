// Environment variables name programs; programs get their words unchanged, and their end is reported.
#include "host/process.hpp"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <thread>

#include <dlfcn.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "host/files.hpp"
#include "tests/message_of.hpp"
#include "tests/sim/environment.hpp"
#include "tests/sim/temporary_folder.hpp"

namespace hitpipe::host {
namespace {

namespace fs = std::filesystem;

/// What happens after a child was started and before run() knows its number.
std::function<void(pid_t child)> when_started;

}  // namespace
}  // namespace hitpipe::host

/// Stands before the system's.
extern "C" int posix_spawnp(pid_t* child, const char* file, const posix_spawn_file_actions_t* actions,
                            const posix_spawnattr_t* attributes, char* const words[],
                            char* const variables[]) {
  static const auto real = reinterpret_cast<decltype(&posix_spawnp)>(dlsym(RTLD_NEXT, "posix_spawnp"));
  const int error = real(child, file, actions, attributes, words, variables);
  if (error == 0 && hitpipe::host::when_started) hitpipe::host::when_started(*child);
  return error;
}

namespace hitpipe::host {
namespace {

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

using std::chrono::milliseconds;
using std::chrono::steady_clock;

/// Whether the process runs; a zombie does not.
bool runs(const std::string& id) {
  const std::optional<std::string> status = contents_of("/proc/" + id + "/stat");
  return status && status->find(") Z ") == std::string::npos;
}

/// Kills reach a process a little later. The limit is only for one that was not killed.
bool is_gone(const std::string& id) {
  const auto deadline = steady_clock::now() + std::chrono::minutes(5);
  while (runs(id) && steady_clock::now() < deadline) std::this_thread::sleep_for(milliseconds(1));
  return !runs(id);
}

bool has_child() {
  return waitpid(-1, nullptr, WNOHANG) != -1 || errno != ECHILD;
}

TEST(Run, ProgramThatHangsIsStoppedWithAllThatItStarted) {
  milliseconds limit{250};
  Outcome ended;
  do {  // until it has said all before it is stopped
    limit *= 2;
    ended = run({"sh", "-c", "sleep 1000 & echo said $!; exec sleep 1000"}, {.time_limit = limit});
    EXPECT_FALSE(ended.succeeded());
    EXPECT_EQ(ended.failure(), fmt::format("did not end within {:g} s and was stopped",
                                           0.001 * static_cast<double>(limit.count())));
  } while (ended.out.empty());
  ASSERT_TRUE(ended.out.starts_with("said "));
  EXPECT_TRUE(is_gone(ended.out.substr(5, ended.out.size() - 6)));
  EXPECT_FALSE(has_child());
}

/// Its pipes close long before its end.
TEST(Run, ProgramThatHangsInSilenceIsStopped) {
  const Outcome ended = run({"sh", "-c", "exec >&- 2>&-; sleep 1000"}, {.time_limit = milliseconds(300)});
  EXPECT_EQ(ended.failure(), "did not end within 0.3 s and was stopped");
  EXPECT_FALSE(has_child());
}

TEST(Run, ProgramThatClosesItsOutputIsWaitedFor) {
  const Outcome ended = run({"sh", "-c", "exec >&- 2>&-; sleep 0.1; exit 5"});
  EXPECT_EQ(ended.failure(), "failed with exit code 5");
}

TEST(Run, EndsWithItsProgramAlthoughAGrandchildKeepsThePipesOpen) {
  const Outcome ended = run({"sh", "-c", "sleep 1000 & echo $!; head -c 100000 /dev/zero >&2"});
  EXPECT_TRUE(ended.succeeded());
  EXPECT_EQ(ended.err, std::string(100'000, '\0'));
  const std::string grandchild = ended.out.substr(0, ended.out.size() - 1);
  EXPECT_TRUE(runs(grandchild));
  kill(std::stoi(grandchild), SIGKILL);
}

/// Waits until the tester's child has written its number.
std::string child_in(const fs::path& folder) {
  while (!fs::exists(folder / "child")) std::this_thread::sleep_for(milliseconds(1));
  const std::string text = read_file(folder / "child");
  return text.substr(0, text.size() - 1);
}

const std::vector<std::string> tells_its_number{"sh", "-c", "echo $$ > part; mv part child; exec sleep 1000"};

/// poll() refuses more descriptors than a process may have.
TEST(Run, LeavesNoChildWhenItsOutputCannotBeRead) {
  const TemporaryFolder folder;
  const pid_t tester = fork();
  if (tester == 0) {
    try {
      static_cast<void>(run(tells_its_number, {.folder = folder.path()}));
    } catch (const std::runtime_error& error) {
      _exit(std::string_view(error.what()).starts_with("cannot read what a program prints")
                ? (has_child() ? 1 : 0)
                : 2);
    }
    _exit(3);
  }
  const std::string child = child_in(folder.path());
  const rlimit none{1, 1};
  ASSERT_EQ(prlimit(tester, RLIMIT_NOFILE, &none, nullptr), 0);
  int status = 0;
  ASSERT_EQ(waitpid(tester, &status, 0), tester);
  EXPECT_EQ(status, 0);
  EXPECT_TRUE(is_gone(child));
}

/// As Ctrl-C in a terminal does, which reaches only the program's own group.
TEST(Run, SignalThatEndsTheProgramEndsItsChildren) {
  const TemporaryFolder folder;
  const pid_t tester = fork();
  if (tester == 0) {
    static_cast<void>(run(tells_its_number, {.folder = folder.path()}));
    _exit(0);
  }
  const std::string child = child_in(folder.path());
  kill(tester, SIGINT);
  int status = 0;
  ASSERT_EQ(waitpid(tester, &status, 0), tester);
  EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGINT);
  EXPECT_TRUE(is_gone(child));
}

/// A program that runs a child and gets SIGINT before run() knows the child's number. `send` gets the program
/// and sends it. Returns the child's number.
std::string started_at_signal(const std::function<void()>& send) {
  int told[2];
  EXPECT_EQ(pipe(told), 0);
  const pid_t tester = fork();
  if (tester == 0) {
    when_started = [&](pid_t child) {
      const std::string number = std::to_string(child);
      if (write(told[1], number.data(), number.size()) < 0) _exit(1);
      send();
    };
    static_cast<void>(run({"sleep", "1000"}));
    _exit(0);
  }
  close(told[1]);
  std::string child(20, '\0');
  child.resize(static_cast<std::size_t>(std::max<ssize_t>(read(told[0], child.data(), child.size()), 0)));
  close(told[0]);
  int status = 0;
  EXPECT_EQ(waitpid(tester, &status, 0), tester);
  EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGINT);
  return child;
}

TEST(Run, ChildThatHasJustBeenStartedIsEndedToo) {
  EXPECT_TRUE(is_gone(started_at_signal([] { kill(getpid(), SIGINT); })));
}

/// The signal may come to any thread.
TEST(Run, ChildThatAnotherThreadHasJustStartedIsEndedToo) {
  EXPECT_TRUE(is_gone(started_at_signal([] {
    std::thread other([] {
      sigset_t all;
      sigemptyset(&all);
      pthread_sigmask(SIG_SETMASK, &all, nullptr);
      kill(getpid(), SIGINT);
      for (;;) pause();
    });
    other.detach();
    // Time for what a wrong program does. A right one waits for this.
    std::this_thread::sleep_for(milliseconds(100));
  })));
}

/// The child may be ended by signals that were blocked when it was started.
TEST(Run, ChildGetsTheSignalsOfItsProgram) {
  EXPECT_EQ(run({"sh", "-c", "kill -INT $$; echo lives"}).signal, SIGINT);
}

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
