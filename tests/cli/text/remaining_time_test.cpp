// The time that is left follows what the last third of the time has brought.
#include "cli/text/remaining_time.hpp"

#include <gtest/gtest.h>

namespace hitpipe::cli::remaining_time_test {
namespace {

using Seconds = RemainingTime::Duration;

TEST(RemainingTime, OfEvenWorkIsTheRest) {
  RemainingTime time;
  EXPECT_FALSE(time.left());
  for (int second = 1; second <= 25; ++second) time.add(Seconds(second), second / 100.0);
  EXPECT_NEAR(time.left().value().count(), 75, 1e-9);
}

/// 80 % in 80 s, then a row of 20 % takes 200 s: half of it is done after 100 s.
TEST(RemainingTime, FollowsWorkThatBecomesSlower) {
  RemainingTime time;
  for (int second = 1; second <= 80; ++second) time.add(Seconds(second), second / 100.0);
  for (int second = 1; second <= 100; ++second) time.add(Seconds(80 + second), 0.8 + second / 1000.0);
  EXPECT_NEAR(time.left().value().count(), 100, 1);
}

TEST(RemainingTime, IsNotSaidWhileNothingGetsDone) {
  RemainingTime time;
  time.add(Seconds(1), 0.0);
  EXPECT_FALSE(time.left());
  time.add(Seconds(10), 0.5);
  EXPECT_NEAR(time.left().value().count(), 9, 1e-9);
  for (int second = 11; second <= 60; ++second) time.add(Seconds(second), 0.5);
  EXPECT_FALSE(time.left());
}

TEST(RemainingTime, IsNoneAtTheEnd) {
  RemainingTime time;
  time.add(Seconds(4), 1.0);
  EXPECT_EQ(time.left().value().count(), 0);
}

}  // namespace
}  // namespace hitpipe::cli::remaining_time_test
