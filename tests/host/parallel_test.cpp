// There are no more threads than asked for, and every index comes once.
#include "host/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/task_arena.h>

namespace hitpipe::host {
namespace {

int threads_within(int threads) {
  int found = 0;
  with_threads(threads, [&] { found = tbb::this_task_arena::max_concurrency(); });
  return found;
}

TEST(WithThreads, GivesNoMoreThanAskedAndNoMoreThanCores) {
  const int cores = tbb::info::default_concurrency();
  EXPECT_EQ(threads_within(1), 1);
  EXPECT_EQ(threads_within(2), std::min(2, cores));
  EXPECT_EQ(threads_within(10'000), cores);
  EXPECT_EQ(threads_within(0), cores);
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

TEST(ForEachIndex, HandsOnAnError) {
  EXPECT_THROW(for_each_index(10, 2, [](std::size_t) { throw std::runtime_error("no"); }),
               std::runtime_error);
}

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
