// The sampled time is the time of the work, without reading the clock and without interruptions.
#include "sim/cosim/sampled_time.hpp"

#include <gtest/gtest.h>

namespace hitpipe::sim::sampled_time_test {
namespace {

using std::chrono::nanoseconds;

/// Advances only by what the test adds. Each reading takes 25 ns.
struct TestClock {
  using duration = nanoseconds;
  using time_point = std::chrono::time_point<TestClock, duration>;
  static inline nanoseconds elapsed{0};

  static time_point now() {
    elapsed += nanoseconds(25);
    return time_point(elapsed);
  }
};

void work_for(std::int64_t ns) {
  TestClock::elapsed += nanoseconds(ns);
}

TEST(SampledTime, RunsEveryPieceOnce) {
  SampledTime<> time;
  int runs = 0;
  for (int i = 0; i < 1000; ++i) time.run([&] { ++runs; });
  EXPECT_EQ(runs, 1000);
}

TEST(SampledTime, IsThatOfThePiecesWithoutTheClock) {
  SampledTime<TestClock> time;
  TestClock::elapsed = nanoseconds(0);
  constexpr int pieces = 10'000;
  for (int i = 0; i < pieces; ++i) time.run([] { work_for(100); });
  EXPECT_DOUBLE_EQ(time.seconds(), pieces * 100e-9);
  // Sampling costs only three readings for one piece in 61.
  EXPECT_LE(TestClock::elapsed, nanoseconds(pieces * 100 + 3 * 25 * (pieces / 61 + 1)));
}

TEST(SampledTime, LeavesInterruptedPiecesOut) {
  SampledTime<TestClock> time;
  for (int i = 0; i < 10'000; ++i) time.run([i] { work_for(i % 3 == 0 ? 4'000'000 : 100); });
  EXPECT_DOUBLE_EQ(time.seconds(), 10'000 * 100e-9);
}

TEST(SampledTime, OfNothingIsZero) {
  SampledTime<TestClock> time;
  EXPECT_EQ(time.seconds(), 0.0);
  time.run([] { work_for(100); });
  EXPECT_EQ(time.seconds(), 0.0);
}

}  // namespace
}  // namespace hitpipe::sim::sampled_time_test
