// The float operators in the vendor's domain against the native one, on every pair of binary32 corners and on
// random pairs. Built only where HITPIPE_VENDOR_AP_INT names a folder with the vendor's ap_int.h.
#include <cstddef>
#include <cstdint>
#include <iostream>
#include <vector>

#include <gtest/gtest.h>

#include "hls/num/vendor.hpp"
#include "tests/hls/num/float_corners.hpp"
#include "tests/hls/num/float_operators.hpp"

namespace hitpipe::hls {
namespace {

class Check {
 public:
  void pair(std::uint32_t a, std::uint32_t b) {
    using Bits = Vendor::uint<32>;
    one("a - b", a, b, fp_logic::subtract<Vendor>(Fp32(), Bits(a), Bits(b)).to_uint64(),
        exact::subtract_bits<8, 23>(a, b));
    one("a * b", a, b, fp_logic::multiply<Vendor>(Fp32(), Bits(a), Bits(b)).to_uint64(),
        exact::multiply_bits<8, 23>(a, b));
    one("compare(a, b)", a, b, fp_logic::compare<Vendor>(Fp32(), Bits(a), Bits(b)).to_uint64(),
        exact::compare_bits<8, 23>(a, b));
  }

  void finish(std::size_t pairs) const {
    EXPECT_EQ(failed_, 0U);
    EXPECT_EQ(checked_, 3 * pairs);
    std::cout << checked_ << " results checked\n";
  }

 private:
  void one(const char* operation, std::uint32_t a, std::uint32_t b, std::uint64_t got, std::uint64_t native) {
    ++checked_;
    if (got == native || ++failed_ > 5) return;
    ADD_FAILURE() << operation << std::hex << ", a 0x" << a << ", b 0x" << b << ": vendor 0x" << got
                  << ", native 0x" << native;
  }

  std::size_t checked_ = 0;
  std::size_t failed_ = 0;
};

TEST(VendorFloats, EveryPairOfCornersIsTheNativeOne) {
  const std::vector<std::uint32_t> corners = exact::corner_floats();
  Check check;
  for (const std::uint32_t a : corners) {
    for (const std::uint32_t b : corners) check.pair(a, b);
  }
  check.finish(exact::corner_float_count * exact::corner_float_count);
}

TEST(VendorFloats, RandomPairsAreTheNativeOnes) {
  constexpr std::uint64_t seed = 91;
  constexpr std::size_t pairs = 20'000;
  std::cout << "seed " << seed << '\n';
  exact::FloatPairs random(seed);
  Check check;
  for (std::size_t i = 0; i < pairs; ++i) {
    const exact::FloatPair p = random.next();
    check.pair(p.a, p.b);
  }
  check.finish(pairs);
}

}  // namespace
}  // namespace hitpipe::hls
