// Where a logarithmic axis ends, and which tics have room.
#include "cli/report/log_axis.hpp"

#include <cmath>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace hitpipe::cli::log_axis_test {
namespace {

TEST(LogAxis, EndsWhereTheDataDoes) {
  const LogAxis axis(std::vector<double>{0.5, 20, 3});
  EXPECT_LT(axis.least(), 0.5);
  EXPECT_GT(axis.least(), 0.4);
  EXPECT_GT(axis.most(), 20);
  EXPECT_LT(axis.most(), 25);
  EXPECT_EQ(axis.tics_upward(1000), "'0.5' 0.5, '1' 1, '2' 2, '5' 5, '10' 10, '20' 20");
  const LogAxis narrow(std::vector<double>{1, 1.6});
  EXPECT_EQ(narrow.tics_upward(1000), "'1' 1, '1.1' 1.1, '1.2' 1.2, '1.3' 1.3, '1.4' 1.4, '1.6' 1.6");
  const LogAxis one(std::vector<double>{7});
  EXPECT_LT(one.least(), 7);
  EXPECT_GT(one.most(), 7);
}

TEST(LogAxis, HasAPlaceForWhatIsNotPositive) {
  const LogAxis axis(std::vector<double>{-1, 0, 10, 1000});
  EXPECT_EQ(axis.shown(-1), axis.shown(0));
  EXPECT_LT(axis.shown(0), 10);
  EXPECT_GT(axis.share(0), 0);
  EXPECT_NEAR(axis.shown(0), 10 / std::pow(100, 0.3), 1e-12);
  // Labels have room below and above the units there.
  EXPECT_GT(axis.share(0), 0.06);
  EXPECT_GT(axis.share(10) - axis.share(0), 0.2);
  EXPECT_THAT(axis.tics_upward(1000), testing::StartsWith("'≤ 0' 2.512, '10' 10, "));
  const LogAxis nothing(std::vector<double>{0, 0});
  EXPECT_GT(nothing.share(0), 0);
  EXPECT_LT(nothing.share(0), 1);
}

TEST(LogAxis, TicsHaveRoom) {
  const LogAxis axis(std::vector<double>{0.001, 10000});
  EXPECT_EQ(axis.tics_across(1000),
            "'0.001' 0.001, '0.01' 0.01, '0.1' 0.1, '1' 1, '10' 10, '100' 100, '1000' 1000, '10000' 1e+04");
  EXPECT_EQ(axis.tics_across(150), "'0.001' 0.001, '0.1' 0.1, '1' 1, '10' 10, '1000' 1000");
  EXPECT_EQ(axis.tics_upward(60), "'0.001' 0.001, '1' 1, '1000' 1000");
  const LogAxis short_one(std::vector<double>{1, 50});
  EXPECT_EQ(short_one.tics_across(1000), "'1' 1, '3' 3, '10' 10, '30' 30");
  EXPECT_EQ(short_one.tics_across(40), "'1' 1, '10' 10");
}

}  // namespace
}  // namespace hitpipe::cli::log_axis_test
