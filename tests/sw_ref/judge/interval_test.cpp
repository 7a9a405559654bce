#include "sw_ref/judge/interval.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace hitpipe::ref::interval_test {
namespace {

void expect_interval(Interval interval, double low, double high) {
  EXPECT_NEAR(interval.low, low, 5e-5);
  EXPECT_NEAR(interval.high, high, 5e-5);
}

// Newcombe 1998, Statistics in Medicine 17, table I, method 3.
TEST(WilsonInterval, HasTheValuesThatNewcombePrints) {
  expect_interval(wilson_interval(81, 263), 0.2553, 0.3662);
  expect_interval(wilson_interval(15, 148), 0.0624, 0.1605);
  expect_interval(wilson_interval(0, 20), 0.0, 0.1611);
  expect_interval(wilson_interval(1, 29), 0.0061, 0.1718);
}

TEST(WilsonInterval, IsMirroredAndEndsAtTheSharesThatAreCertain) {
  const Interval few = wilson_interval(3, 40);
  const Interval many = wilson_interval(37, 40);
  EXPECT_NEAR(few.low, 1 - many.high, 1e-12);
  EXPECT_NEAR(few.high, 1 - many.low, 1e-12);
  EXPECT_EQ(wilson_interval(0, 1'000'000).low, 0.0);
  EXPECT_EQ(wilson_interval(1'000'000, 1'000'000).high, 1.0);
  expect_interval(wilson_interval(0, 0), 0.0, 1.0);
}

TEST(GroupedRatio, OfIndependentCasesIsWilsonsInterval) {
  GroupedRatio shares;
  for (int i = 0; i < 263; ++i) shares.add(i < 81 ? 1 : 0, 1);
  EXPECT_DOUBLE_EQ(shares.ratio(), 81.0 / 263);
  EXPECT_NEAR(shares.share_interval().low, wilson_interval(81, 263).low, 5e-4);
  EXPECT_NEAR(shares.share_interval().high, wilson_interval(81, 263).high, 5e-4);
}

TEST(GroupedRatio, CasesThatAreCopiesOfEachOtherCountOnce) {
  GroupedRatio shares;
  for (int i = 0; i < 263; ++i) shares.add(i < 81 ? 32 : 0, 32);
  EXPECT_NEAR(shares.share_interval().low, wilson_interval(81, 263).low, 5e-4);
  GroupedRatio none;
  for (int i = 0; i < 20; ++i) none.add(0, 32);
  expect_interval(none.share_interval(), 0.0, 0.1611);
}

/// The share of samples whose interval holds the true ratio.
template <class Sample>
double share_that_hold(double truth, const Sample& sample) {
  constexpr int samples = 2'000;
  int holds = 0;
  for (int i = 0; i < samples; ++i) {
    const Interval interval = sample();
    holds += interval.low <= truth && truth <= interval.high ? 1 : 0;
  }
  return holds / static_cast<double>(samples);
}

TEST(GroupedRatio, HoldsTheTrueRatioIn95OfAHundredSamples) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> share(0.2, 0.4);
  const auto of_four_groups = [&] {
    GroupedRatio ratio;
    for (int group = 0; group < 4; ++group)
      ratio.add(std::binomial_distribution<int>(1'000, share(random))(random), 1'000);
    return ratio.share_interval();
  };
  EXPECT_NEAR(share_that_hold(0.3, of_four_groups), 0.95, 0.02);
  random.seed(1);
  std::exponential_distribution<double> size(0.1);
  const auto of_many_groups = [&] {
    GroupedRatio ratio;
    for (int group = 0; group < 200; ++group) {
      const double below = 1 + size(random);
      ratio.add(1.5 * below + size(random) - 10, below);
    }
    return ratio.interval();
  };
  EXPECT_NEAR(share_that_hold(1.5, of_many_groups), 0.95, 0.02);
}

TEST(Share, IntervalHoldsTheTrueShareIn95OfAHundredSamples) {
  std::mt19937_64 random(3);
  for (const double truth : {0.0005, 0.01, 0.3, 0.999}) {
    std::binomial_distribution<std::uint64_t> drawn(20'000, truth);
    const auto sample = [&] { return Share{drawn(random), 20'000}.percent_interval(); };
    EXPECT_NEAR(share_that_hold(100 * truth, sample), 0.95, 0.02) << truth;
  }
  EXPECT_DOUBLE_EQ((Share{1, 4}.percent()), 25);
  EXPECT_EQ((Share{0, 0}.percent()), 0);
}

/// A group with as many tests as its reference, or with more in few groups.
TEST(ExtraWork, HoldsTheTruePercentIn95OfAHundredSamples) {
  std::mt19937_64 random(2);
  std::geometric_distribution<std::uint64_t> size(0.05), more(0.2);
  for (const double groups_with_more : {0.005, 0.01, 0.1, 0.7}) {
    std::bernoulli_distribution has_more(groups_with_more);
    // A geometric number is (1 - p) / p on average.
    const double truth = 100 * groups_with_more * (1 + 4.0) / (10 + 19.0);
    const auto sample = [&] {
      ExtraWork extra;
      for (int group = 0; group < 1'000; ++group) {
        const std::uint64_t reference = 10 + size(random);
        extra.add(reference + (has_more(random) ? 1 + more(random) : 0), reference);
      }
      return *extra.percent_interval();
    };
    EXPECT_NEAR(share_that_hold(truth, sample), 0.95, 0.02) << groups_with_more;
  }
  std::uniform_int_distribution<std::uint64_t> other(0, 20);
  const auto of_less_and_more = [&] {
    ExtraWork extra;
    for (int group = 0; group < 300; ++group) extra.add(20 + other(random), 20 + other(random));
    return *extra.percent_interval();
  };
  EXPECT_NEAR(share_that_hold(0, of_less_and_more), 0.95, 0.02);
}

TEST(ExtraWork, OfNoneIsBoundByTheNumberOfGroups) {
  ExtraWork none;
  EXPECT_FALSE(none.percent_interval());
  for (int group = 0; group < 20; ++group) none.add(32, 32);
  EXPECT_EQ(none.percent(), 0);
  expect_interval(*none.percent_interval(), 0.0, 16.1125);
}

TEST(ExtraWork, AddsUp) {
  ExtraWork first, second;
  first.add(40, 32);
  second.add(30, 32);
  second.add(33, 32);
  ExtraWork all;
  all.add(40, 32);
  all.add(30, 32);
  all.add(33, 32);
  first += second;
  EXPECT_EQ(first.percent(), all.percent());
  EXPECT_EQ(first.percent_interval()->low, all.percent_interval()->low);
  EXPECT_EQ(first.percent_interval()->high, all.percent_interval()->high);
  EXPECT_LT(all.percent_interval()->low, 0) << "a group with less makes it symmetrical";
}

TEST(Middle, HasAnIntervalFromSixValuesOn) {
  EXPECT_FALSE(middle_of({5, 1, 4, 2, 3}).interval);
  EXPECT_EQ(middle_of({5, 1, 4, 2, 3}).median, 3);
  const Middle six = middle_of({6, 5, 1, 4, 2, 3});
  EXPECT_EQ(six.median, 3.5);
  ASSERT_TRUE(six.interval);
  EXPECT_EQ(six.interval->low, 1);
  EXPECT_EQ(six.interval->high, 6);
  // Of 9 coins at most one falls on one side in 3.9 % of all throws, of 12 at most two.
  EXPECT_EQ(middle_of({1, 2, 3, 4, 5, 6, 7, 8, 9}).interval->low, 2);
  EXPECT_EQ(middle_of({1, 2, 3, 4, 5, 6, 7, 8, 9}).interval->high, 8);
  EXPECT_EQ(middle_of({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}).interval->low, 3);
}

TEST(Middle, IntervalHoldsTheMedianAsOftenAsItSays) {
  std::mt19937 random(7);
  std::exponential_distribution<double> values(1);  // its median is the logarithm of 2
  int held = 0;
  constexpr int samples = 20'000;
  for (int i = 0; i < samples; ++i) {
    std::vector<double> sample(7);
    for (double& value : sample) value = values(random);
    const Interval of = *middle_of(sample).interval;
    held += of.low <= std::log(2.0) && std::log(2.0) <= of.high ? 1 : 0;
  }
  EXPECT_NEAR(held / double{samples}, 1 - 2.0 / 128, 0.003);
}

TEST(Middle, OfARatioIsRunByRun) {
  const std::vector<double> above{2, 6, 9}, below{1, 2, 3};
  EXPECT_EQ(middle_ratio(above, below).median, 3);
}

TEST(GroupedRatio, GroupWithNothingBelowTheLineStillCountsAbove) {
  GroupedRatio ratio;
  ratio.add(2, 4);
  ratio.add(3, 0);
  EXPECT_DOUBLE_EQ(ratio.ratio(), 1.25);
  EXPECT_EQ(ratio.groups(), 2U);
}

TEST(GroupedRatio, AddsUpInAnyOrderAndLeavesOutEmptyGroups) {
  GroupedRatio first;
  first.add(3, 7);
  first.add(0, 0);
  GroupedRatio second;
  second.add(5, 9);
  GroupedRatio sum = first;
  sum += second;
  second += first;
  EXPECT_EQ(sum.groups(), 2U);
  EXPECT_DOUBLE_EQ(sum.ratio(), 0.5);
  EXPECT_EQ(sum.interval().low, second.interval().low);
  EXPECT_TRUE(std::isinf(first.interval().high)) << "one group has no spread";
}

}  // namespace
}  // namespace hitpipe::ref::interval_test
