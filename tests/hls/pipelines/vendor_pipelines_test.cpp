// The pipelines compiled against a vendor's ap_int.h give the native HIT for the same operands. Built only
// where HITPIPE_VENDOR_AP_INT names a folder with that header.
#include <cstdint>
#include <iostream>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "hls/num/domain.hpp"
#include "hls/num/vendor.hpp"
#include "hls/pipelines/int_slabs.hpp"

namespace hitpipe::hls {
namespace {

constexpr unsigned seed = 72;
constexpr int vector_count = 50000;

template <class D, class F>
bool hit_of(const std::vector<std::uint64_t>& bits) {
  using Operands = IntSlabs::Operands<D, F>;
  Operands in;
  std::size_t next = 0;
  Operands::for_each(in, [&](const char*, auto& field) { field = bits[next++]; });
  return IntSlabs::hit<D, F>(in).to_bool();
}

/// Half of the vectors are near zero, where the unit says HIT more often.
template <class F>
void expect_equal_hits() {
  std::cout << "seed " << seed << '\n';
  std::mt19937_64 random(seed);
  int hits = 0;
  for (int i = 0; i < vector_count; ++i) {
    std::vector<std::uint64_t> bits(17);
    for (std::uint64_t& b : bits) {
      b = random();
      if (i % 2 == 0) b = static_cast<std::uint64_t>(static_cast<std::int64_t>(b) >> 58);
    }
    const bool native = hit_of<Native, F>(bits);
    ASSERT_EQ(native, (hit_of<Vendor, F>(bits))) << "vector " << i;
    hits += native ? 1 : 0;
  }
  EXPECT_GT(hits, vector_count / 100);
  EXPECT_LT(hits, vector_count - vector_count / 100);
}

TEST(VendorPipelines, IntSlabsAgreesAt24_24) {
  expect_equal_hits<IntFormat<24, 24>>();
}
TEST(VendorPipelines, IntSlabsAgreesAt20_24) {
  expect_equal_hits<IntFormat<20, 24>>();
}
TEST(VendorPipelines, IntSlabsAgreesAtTheNarrowestFormat) {
  expect_equal_hits<IntFormat<6, 6>>();
}
TEST(VendorPipelines, IntSlabsAgreesAtTheWidestFormat) {
  expect_equal_hits<IntFormat<32, 63>>();
}

}  // namespace
}  // namespace hitpipe::hls
