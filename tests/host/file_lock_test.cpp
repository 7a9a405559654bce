// Whoever wants the same number waits, in this process and in others, and a dead process holds nothing.
#include "host/file_lock.hpp"

#include <atomic>
#include <chrono>
#include <system_error>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/sim/temporary_folder.hpp"

namespace hitpipe::host::file_lock_test {
namespace {

using namespace std::chrono_literals;

TEST(FileLock, ThreadsWaitForTheSameNumberOnly) {
  const sim::TemporaryFolder folder;
  const auto file = folder.path() / "locks";
  std::atomic<int> inside = 0;
  std::atomic<int> most = 0;
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i)
    threads.emplace_back([&] {
      const FileLock lock(file, 7);
      most = std::max(most.load(), ++inside);
      std::this_thread::sleep_for(20ms);
      --inside;
    });
  {
    const FileLock other(file, 8);  // it would wait for ever if numbers were one
    for (std::thread& thread : threads) thread.join();
  }
  EXPECT_EQ(most, 1);
}

TEST(FileLock, WaitsForAnotherProcessUntilItDies) {
  const sim::TemporaryFolder folder;
  const auto file = folder.path() / "locks";
  int ready[2];
  ASSERT_EQ(pipe(ready), 0);
  const pid_t child = fork();
  if (child == 0) {
    const FileLock lock(file, 7);
    if (write(ready[1], "x", 1) == 1) pause();
    _exit(0);
  }
  char byte = 0;
  ASSERT_EQ(read(ready[0], &byte, 1), 1);
  std::atomic<bool> locked = false;
  std::thread waiting([&] {
    const FileLock lock(file, 7);
    locked = true;
  });
  std::this_thread::sleep_for(100ms);
  EXPECT_FALSE(locked);
  kill(child, SIGKILL);
  waiting.join();
  EXPECT_TRUE(locked);
  waitpid(child, nullptr, 0);
  close(ready[0]);
  close(ready[1]);
}

TEST(FileLock, FileThatCannotBeMadeRejected) {
  EXPECT_THROW(FileLock("/nowhere/locks", 1), std::system_error);
}

}  // namespace
}  // namespace hitpipe::host::file_lock_test
