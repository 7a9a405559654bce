// Values whose widths are known at run time have the bits, width and sign of ap_int's, operator by operator.
#include "hls/num/sized.hpp"

#include <cstdint>
#include <iostream>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "tests/hls/num/domain_operators.hpp"

namespace hitpipe::hls::sized_test {
namespace {

/// Zero, one, all ones, both ends of either sign and their neighbours, alternating bits, then random ones.
std::vector<std::uint64_t> patterns(int width, std::mt19937_64& random) {
  const std::uint64_t top = std::uint64_t{1} << (width - 1);
  const std::uint64_t ones = ~std::uint64_t{0} >> (64 - width);
  std::vector<std::uint64_t> all{0, 1, ones, ones - 1, top, top - 1, top | 1, 0x5555'5555'5555'5555 & ones};
  for (int i = 0; i < 32; ++i) all.push_back((random() >> random() % 64) & ones);
  return all;
}

TEST(Sized, EveryOperatorMeansWhatApIntsDoes) {
  constexpr std::uint64_t seed = 211;
  std::cout << "seed " << seed << '\n';
  std::mt19937_64 random(seed);
  int pairs = 0;
  std::size_t compared = 0;
  exact::for_each_pair_of_types([&]<class A, class B>() {
    ++pairs;
    const std::vector<std::uint64_t> all_a = patterns(A::width, random);
    const std::vector<std::uint64_t> all_b = patterns(B::width, random);
    std::size_t operators = 0;
    exact::for_each_operator<A, B>([&](const auto& op) {
      ++operators;
      for (const std::uint64_t a : all_a) {
        for (const std::uint64_t b : all_b) {
          const auto native = op.apply(Native(), A(a), B(b));
          const auto sized = op.apply(Sized(), SizedInt<A::is_signed, std::uint64_t>(a, A::width),
                                      SizedInt<B::is_signed, std::uint64_t>(b, B::width));
          static_assert(decltype(sized)::is_signed == decltype(native)::is_signed);
          ASSERT_EQ(sized.width(), decltype(native)::width) << op.name;
          ASSERT_EQ(sized.to_int64(), native.to_int64())
              << op.name << std::hex << ", a 0x" << a << ", b 0x" << b << std::dec << " of " << A::width
              << (A::is_signed ? " signed" : "") << " and " << B::width << (B::is_signed ? " signed" : "")
              << " bits";
          ++compared;
        }
      }
    });
    EXPECT_GE(operators, 20U);
  });
  EXPECT_EQ(pairs, exact::type_pair_count);
  EXPECT_GT(compared, 900'000U);
  std::cout << compared << " results compared\n";
}

TEST(Sized, TakesTheLowBitsOfAWord) {
  EXPECT_EQ(Sized::sint(0x1f8, 4).to_int64(), -8);
  EXPECT_EQ(Sized::uint(0x1f8, 4).to_int64(), 8);
  EXPECT_EQ(Sized::sint(0x1f8, 4).pattern(), 8U);
  EXPECT_EQ(Sized::lit(-1, 5).word(), 0x1fU);
}

static_assert((Sized::sint(5, 4) - Sized::sint(7, 4)).to_int64() == -2);

}  // namespace
}  // namespace hitpipe::hls::sized_test
