// The sampled time is the work's, without the clock's and without interruptions.
#include "sim/sampled_time.hpp"

#include <gtest/gtest.h>

namespace hitpipe::sim {
namespace {

using std::chrono::nanoseconds;

/// Stands still but for what the test lets pass; each reading takes 25 ns.
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
  // Three readings for one piece in 61 are all that it costs.
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
}  // namespace hitpipe::sim
