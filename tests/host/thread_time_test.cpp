// Processor time of a thread.
#include "host/thread_time.hpp"

#include <thread>

#include <gtest/gtest.h>

namespace hitpipe::host {
namespace {

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
  // This thread only waited, so its time is far less than that of the other's work.
  EXPECT_LT(thread_seconds() - before, 0.1);
}

}  // namespace
}  // namespace hitpipe::host
