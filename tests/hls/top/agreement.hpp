// What every top function must show: the results of its pipeline in the native domain.
#pragma once

#include <iostream>

#include <gtest/gtest.h>

#include "hls/top/csim.hpp"

namespace hitpipe::hls {

template <class Pipeline, class F, class... Words>
void expect_agreement(void (*top)(Words...)) {
  constexpr std::uint64_t seed = 91;
  constexpr int test_count = 50000;
  const top::Comparison result = top::compare<Pipeline, F>(top, test_count, seed);
  std::cout << "seed " << seed << ", " << result.tests << " tests, " << result.hits << " hits\n";
  EXPECT_EQ(result.mismatches, 0);
  EXPECT_EQ(result.tests, test_count);
  EXPECT_GT(result.hits, test_count / 100);
  EXPECT_LT(result.hits, test_count - test_count / 100);
}

}  // namespace hitpipe::hls
