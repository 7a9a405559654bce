// There are no more threads than asked for, and every index comes once.
#include "host/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#if defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define HITPIPE_THREAD_SANITIZER
#endif
#endif

namespace hitpipe::host {
namespace {

/// How many threads take part in a loop of many calls, of which each waits until `expected` threads have come.
std::size_t threads_of_loop(int threads, std::size_t expected) {
  std::mutex telling;
  std::condition_variable came;
  std::set<std::thread::id> seen;
  with_threads(threads, [&] {
    for_each_index(200, [&](std::size_t) {
      std::unique_lock lock(telling);
      seen.insert(std::this_thread::get_id());
      came.notify_all();
      came.wait_for(lock, std::chrono::seconds(20), [&] { return seen.size() >= expected; });
    });
  });
  return seen.size();
}

TEST(WithThreads, GivesWhatIsAskedForAndNoMore) {
  const std::size_t cores = std::max(1U, std::thread::hardware_concurrency());
  EXPECT_EQ(threads_of_loop(1, 1), 1);
  EXPECT_EQ(threads_of_loop(2, 2), 2);
  EXPECT_EQ(threads_of_loop(7, 7), 7);
  EXPECT_EQ(threads_of_loop(0, cores), cores);
}

/// The most threads that are at work at one time, where loops call loops.
TEST(WithThreads, IsOfLoopsWithinLoopsInAll) {
  for (const int threads : {1, 2, 3}) {
    std::mutex telling;
    int working = 0;
    int most = 0;
    std::size_t calls = 0;
    with_threads(threads, [&] {
      for_each_index(9, [&](std::size_t) {
        for_each_index(9, [&](std::size_t) {
          for_each_index(3, [&](std::size_t) {
            {
              const std::scoped_lock lock(telling);
              most = std::max(most, ++working);
              ++calls;
            }
            std::this_thread::yield();
            const std::scoped_lock lock(telling);
            --working;
          });
        });
      });
    });
    EXPECT_EQ(calls, 9 * 9 * 3);
    EXPECT_LE(most, threads);
  }
}

/// A thread that waits takes work of the loop it waits for: else one of two would stand still here.
TEST(WithThreads, AThreadThatWaitsHelps) {
  std::mutex telling;
  std::condition_variable came;
  std::set<std::thread::id> seen;
  with_threads(2, [&] {
    for_each_index(2, [&](std::size_t i) {
      if (i == 0) return;
      for_each_index(100, [&](std::size_t) {
        std::unique_lock lock(telling);
        seen.insert(std::this_thread::get_id());
        came.notify_all();
        came.wait_for(lock, std::chrono::seconds(20), [&] { return seen.size() == 2; });
      });
    });
  });
  EXPECT_EQ(seen.size(), 2);
}

TEST(WithThreads, WithinAnotherHasItsOwnLimit) {
  std::atomic<int> calls = 0;
  with_threads(2, [&] {
    for_each_index(4, [&](std::size_t) {
      std::set<std::thread::id> seen;
      with_threads(1, [&] {
        for_each_index(10, [&](std::size_t) {
          seen.insert(std::this_thread::get_id());
          ++calls;
        });
      });
      EXPECT_EQ(seen.size(), 1);
    });
  });
  EXPECT_EQ(calls, 40);
}

TEST(ForEachBlock, CoversTheNumbersOnce) {
  for (const std::size_t block : {1U, 3U, 7U, 100U}) {
    std::vector<std::atomic<int>> calls(20);
    for_each_block(5, 18, block, [&](std::size_t first, std::size_t last) {
      EXPECT_LE(last - first, block);
      for (std::size_t i = first; i < last; ++i) ++calls[i];
    });
    for (std::size_t i = 0; i < calls.size(); ++i) EXPECT_EQ(calls[i], i >= 5 && i < 18 ? 1 : 0) << i;
  }
  for_each_block(3, 3, 4, [](std::size_t, std::size_t) { FAIL(); });
}

TEST(ForEachIndex, CallsEachOnceAndTellsTheProgress) {
  for (const int threads : {1, 2, 0}) {
    std::vector<std::atomic<int>> calls(1'000);
    std::mutex telling;
    std::set<double> shares;
    for_each_index(
        calls.size(), threads, [&](std::size_t i) { ++calls[i]; },
        [&](double share) {
          const std::scoped_lock lock(telling);
          shares.insert(share);
        });
    EXPECT_THAT(calls, testing::Each(testing::Truly([](const std::atomic<int>& n) { return n == 1; })));
    EXPECT_EQ(shares.size(), calls.size());
    EXPECT_EQ(*shares.begin(), 0.001);
    EXPECT_EQ(*shares.rbegin(), 1.0);
  }
}

TEST(ForEachIndex, OneThreadIsTheCallersOwn) {
  std::set<std::thread::id> seen;
  for_each_index(100, 1, [&](std::size_t) { seen.insert(std::this_thread::get_id()); });
  EXPECT_THAT(seen, testing::ElementsAre(std::this_thread::get_id()));
}

TEST(ForEachIndex, HandsOnAnErrorAndBeginsNothingMore) {
  for (const int threads : {1, 2}) {
    std::atomic<std::size_t> calls = 0;
    const auto fail = [&](std::size_t) {
      ++calls;
      throw std::runtime_error("no");
    };
    EXPECT_THROW(for_each_index(1'000, threads, fail), std::runtime_error);
    EXPECT_LE(calls, static_cast<std::size_t>(threads));
  }
}

#ifndef HITPIPE_THREAD_SANITIZER  // which ends a forked process that starts threads
TEST(ForEachIndex, WorksInAForkedProcess) {
  for_each_index(100, 2, [](std::size_t) {});
  const pid_t child = fork();
  if (child == 0) {
    std::atomic<int> calls = 0;
    for_each_index(1'000, 2, [&](std::size_t) { ++calls; });
    _exit(calls == 1'000 ? 0 : 1);
  }
  int status = -1;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_EQ(status, 0);
}
#endif

/// Works until `seconds` of processor time have passed.
void work(double seconds) {
  const double start = thread_seconds();
  while (thread_seconds() < start + seconds) continue;
}

TEST(ThreadSeconds, GrowWithWorkOfTheThreadAlone) {
  const double start = thread_seconds();
  work(0.01);
  const double before = thread_seconds();
  EXPECT_GE(before - start, 0.01);
  double of_other = 0;
  std::thread other([&] {
    work(0.2);
    of_other = thread_seconds();
  });
  other.join();
  EXPECT_GE(of_other, 0.2);
  // This thread only waited, so its time is far less than the other thread's.
  EXPECT_LT(thread_seconds() - before, 0.1);
}

}  // namespace
}  // namespace hitpipe::host
