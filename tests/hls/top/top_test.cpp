// Every top function gives the HIT of its pipeline in the native domain. This build's compiler builds the
// tops at 24/24 and 20/24, and the other one of g++ and clang++ builds them too.
#include <iostream>

#include <gtest/gtest.h>

#include "hls/pipelines/fp_plucker.hpp"
#include "hls/pipelines/fp_slabs.hpp"
#include "hls/pipelines/int_plucker.hpp"
#include "hls/pipelines/int_slabs.hpp"
#include "hls/top/csim.hpp"
#include "hls/top/fp_plucker.hpp"
#include "hls/top/fp_slabs.hpp"
#include "hls/top/int_plucker.hpp"
#include "hls/top/int_slabs.hpp"

namespace hitpipe::hls {
namespace {

constexpr std::uint64_t seed = 91;
constexpr int test_count = 50000;

template <class Pipeline, class... Words>
void expect_agreement(void (*top)(Words...)) {
  const top::Comparison result = top::compare<Pipeline>(top, test_count, seed);
  std::cout << "seed " << seed << ", " << result.tests << " tests, " << result.hits << " hits\n";
  EXPECT_EQ(result.mismatches, 0);
  EXPECT_EQ(result.tests, test_count);
  EXPECT_GT(result.hits, test_count / 100);
  EXPECT_LT(result.hits, test_count - test_count / 100);
}

TEST(Top, IntSlabsAnswersAsItsPipeline) {
  expect_agreement<IntSlabs>(hitpipe_int_slabs);
}
TEST(Top, IntPluckerAnswersAsItsPipeline) {
  expect_agreement<IntPlucker>(hitpipe_int_plucker);
}
TEST(Top, FpSlabsAnswersAsItsPipeline) {
  expect_agreement<FpSlabs>(hitpipe_fp_slabs);
}
TEST(Top, FpPluckerAnswersAsItsPipeline) {
  expect_agreement<FpPlucker>(hitpipe_fp_plucker);
}

TEST(Top, FormatIsTheMacros) {
  EXPECT_EQ(top::Integers::bits, (IntBits{TESTED_COORD_BITS, TESTED_INTERVAL_BITS}));
}

void says_nothing(top::Coord, top::Coord, top::Coord, top::Interval, top::Coord, top::Coord, top::Coord,
                  top::Coord, top::Coord, top::Coord, top::Bit, top::Coord, top::Coord, top::Coord,
                  top::Coord, top::Coord, top::Coord, top::Bit&) {}

TEST(Comparison, CountsEveryWrongAnswer) {
  EXPECT_EQ(top::compare<IntSlabs>(says_nothing, 100, seed).mismatches, 100);
}

}  // namespace
}  // namespace hitpipe::hls
