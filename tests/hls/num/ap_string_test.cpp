// Text of an ap_int in every radix, and the refusal of others.
#include "hls/num/ap_string.hpp"

#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/hls/num/run.hpp"

namespace hitpipe::hls::ap_string_test {
namespace {

template <class A>
std::size_t check_decimals(std::mt19937_64& random) {
  std::size_t checked = 0;
  const exact::Type type = exact::type_of<A>;
  for (const exact::Integer& corner : exact::corners(type)) {
    for (const exact::Integer& x : {corner, exact::random_value(type, random)}) {
      EXPECT_EQ(exact::make<A>(exact::to_raw(x)).to_string(), x.str());
      ++checked;
    }
  }
  return checked;
}

TEST(ApIntString, Radix10IsTheValue) {
  constexpr unsigned seed = 51;
  std::cout << "seed " << seed << '\n';
  std::mt19937_64 random(seed);
  std::size_t checked = 0;
  exact::with_types([&]<class A>() { checked += check_decimals<A>(random); },
                    exact::Widths<1, 2, 3, 4, 24, 63, 64, 65, 128, 129, 512>{});
  EXPECT_EQ(checked, 2u * 11u * 2u * exact::corner_count);
}

TEST(ApIntString, OtherRadicesShowTheStoredBits) {
  EXPECT_EQ(ap_int<5>(-3).to_string(2), "0b11101");
  EXPECT_EQ(ap_uint<5>(3).to_string(2), "0b00011");
  EXPECT_EQ(ap_int<7>(-1).to_string(8), "0o177");
  EXPECT_EQ(ap_int<24>(-2).to_string(16), "0xfffffe");
  EXPECT_EQ(ap_uint<130>(255).to_string(16), "0x0000000000000000000000000000000ff");
  EXPECT_EQ(ap_int<1>(-1).to_string(), "-1");
}

TEST(ApIntString, OtherRadixRejected) {
  EXPECT_THAT(
      [] { return ap_uint<8>(1).to_string(7); },
      testing::ThrowsMessage<std::runtime_error>("ap_int::to_string: radix 7, allowed are 2, 8, 10 and 16"));
}

}  // namespace
}  // namespace hitpipe::hls::ap_string_test
