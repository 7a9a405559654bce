// A signal that ends the program leaves neither children nor temporary files, and says how the work goes on.
#include "host/ending.hpp"

#include <array>
#include <csignal>
#include <fstream>
#include <functional>
#include <string>
#include <thread>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "host/files.hpp"
#include "host/process.hpp"

namespace hitpipe::host::ending_test {
namespace {

namespace fs = std::filesystem;

/// Runs `work` in a process of its own, which calls its argument and then gets the signal. Returns what it
/// wrote to standard error.
std::string ended_by(int number, const std::function<void(const std::function<void()>& ready)>& work) {
  std::array<int, 2> ready{};
  std::array<int, 2> error{};
  EXPECT_EQ(pipe(ready.data()), 0);
  EXPECT_EQ(pipe(error.data()), 0);
  const pid_t process = fork();
  if (process == 0) {
    dup2(error[1], STDERR_FILENO);
    close(error[1]);
    end_by_signals_cleanly();
    work([&] { static_cast<void>(write(ready[1], "x", 1) == 1); });
    for (;;) pause();
  }
  close(ready[1]);
  close(error[1]);
  char byte = 0;
  EXPECT_EQ(read(ready[0], &byte, 1), 1);
  kill(process, number);
  int status = 0;
  EXPECT_EQ(waitpid(process, &status, 0), process);
  EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == number) << status;
  std::string said;
  std::array<char, 4096> buffer{};
  for (ssize_t got = 0; (got = read(error[0], buffer.data(), buffer.size())) > 0;)
    said.append(buffer.data(), static_cast<std::size_t>(got));
  close(ready[0]);
  close(error[0]);
  return said;
}

class Ending : public testing::TestWithParam<int> {};

TEST_P(Ending, RemovesTemporaryFilesAndFolders) {
  const ScratchFolder all;
  ended_by(GetParam(), [&](const auto& ready) {
    const ScratchFolder folder(all.path(), "work-");
    fs::create_directories(folder / "a" / "b");
    for (int i = 0; i < 500; ++i) std::ofstream(folder / "a" / "b" / std::to_string(i)) << "text";
    fs::create_symlink(all / "outside", folder / "a" / "link");
    write_file(all / "outside" / "kept", "text");
    PendingFile pending(all / "result.csv");
    pending.write("text");
    ready();
    for (;;) pause();
  });
  EXPECT_EQ(std::distance(fs::directory_iterator(all.path()), {}), 1) << "a temporary file is left";
  EXPECT_TRUE(fs::exists(all / "outside" / "kept"));
}

/// The folder of a tool that works in it, and does not obey the signal.
TEST_P(Ending, EndsChildrenBeforeItRemovesTheirFolders) {
  const ScratchFolder all;
  const std::string hangs =
      "trap '' INT TERM HUP; echo > made; mv made ../made; while :; do echo > again; done";
  ended_by(GetParam(), [&](const auto& ready) {
    const ScratchFolder folder(all.path(), "work-");
    std::thread([&] {
      while (!fs::exists(all / "made")) usleep(1000);
      ready();
    }).detach();
    static_cast<void>(run({"sh", "-c", hangs}, {.folder = folder.path()}));
  });
  EXPECT_EQ(std::distance(fs::directory_iterator(all.path()), {}), 1) << "the folder is left";
}

TEST_P(Ending, SaysWhatIsToBeSaidAtThatMoment) {
  EXPECT_EQ(ended_by(GetParam(),
                     [](const auto& ready) {
                       { const AtEnding before({.say = "before\n"}); }
                       const AtEnding now({.say = "now\n"});
                       ready();
                       for (;;) pause();
                     }),
            "now\n");
}

/// A process that was forked has the list of its parent.
TEST_P(Ending, OfAForkedProcessLeavesWhatIsItsParents) {
  const ScratchFolder ours;
  ended_by(GetParam(), [](const auto& ready) { ready(); });
  EXPECT_TRUE(fs::exists(ours.path()));
}

INSTANTIATE_TEST_SUITE_P(Signals, Ending, testing::Values(SIGINT, SIGTERM, SIGHUP),
                         [](const auto& number) { return std::string(sigabbrev_np(number.param)); });

}  // namespace
}  // namespace hitpipe::host::ending_test
