// Words of 128 bits, bit by bit.
#include "rtl_gen/graph/word.hpp"

#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace hitpipe::rtl::word_test {
namespace {

TEST(Word, IsAskedForItsBitsAtEachWidth) {
  for (int width = 0; width <= 128; ++width) {
    const Word below = ones_below(width);
    for (int i = 0; i < 128; ++i) ASSERT_EQ(below >> i & 1, i < width ? 1U : 0U) << width << " " << i;
    EXPECT_EQ(count_of_ones(below), width);
    EXPECT_EQ(low_ones(below), width);
    EXPECT_EQ(low_zeros(~below), width);
    EXPECT_EQ(width_of_bits(below), width);
    if (width == 128) break;
    EXPECT_EQ(width_of_bits(Word{1} << width), width + 1);
    EXPECT_EQ(count_of_ones(Word{1} << width), 1);
    EXPECT_EQ(low_zeros(Word{1} << width), width);
  }
}

TEST(Word, IsReadInTwosComplement) {
  for (int width = 1; width <= 128; ++width) {
    const Word top = Word{1} << (width - 1);
    EXPECT_TRUE(number_of(ones_below(width), width) == -1) << width;
    EXPECT_TRUE(number_of(top, width) == -static_cast<Number>(top - 1) - 1) << width;
    EXPECT_TRUE(number_of(top - 1, width) == static_cast<Number>(top - 1)) << width;
    EXPECT_TRUE(number_of(~Word{0} << (width - 1), width) == number_of(top, width))
        << "bits above are ignored";
  }
  static_assert(number_of(std::uint64_t{0xFF}, 8) == -1 && number_of(std::uint64_t{0x7F}, 8) == 127);
}

TEST(Word, HasRunsOfOnes) {
  std::vector<std::pair<int, int>> runs;
  for_each_run(bit_range(127, 126) | bit_range(64, 63) | 0x5,
               [&](int high, int low) { runs.emplace_back(high, low); });
  EXPECT_EQ(runs, (std::vector<std::pair<int, int>>{{0, 0}, {2, 2}, {64, 63}, {127, 126}}));
  runs.clear();
  for_each_run(~Word{0}, [&](int high, int low) { runs.emplace_back(high, low); });
  EXPECT_EQ(runs, (std::vector<std::pair<int, int>>{{127, 0}}));
}

}  // namespace
}  // namespace hitpipe::rtl::word_test
