// The pipelines compiled against a vendor's ap_int.h give the native results for the same operands. Built
// only where HITPIPE_VENDOR_AP_INT names a folder with that header.
#include <cstdint>
#include <iostream>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "hls/num/domain.hpp"
#include "hls/num/vendor.hpp"
#include "hls/pipelines/fp_plucker.hpp"
#include "hls/pipelines/fp_slabs.hpp"
#include "hls/pipelines/int_plucker.hpp"
#include "hls/pipelines/int_slabs.hpp"
#include "hls/top/csim.hpp"

namespace hitpipe::hls {
namespace {

constexpr unsigned seed = 72;
constexpr int vector_count = 50000;

template <class Pipeline, class F>
void expect_equal_results() {
  std::cout << "seed " << seed << ", " << vector_count << " vectors\n";
  std::mt19937_64 random(seed);
  int hits = 0;
  for (int i = 0; i < vector_count; ++i) {
    const auto words = top::random_operands<Pipeline, F>(random);
    const auto native = top::pipeline_results<Pipeline, Native, F>(words);
    const auto vendor = top::pipeline_results<Pipeline, Vendor, F>(words);
    for (std::size_t result = 0; result < native.size(); ++result)
      ASSERT_EQ(vendor[result].word, native[result].word)
          << "vector " << i << " " << native[result].port.name;
    hits += top::is_hit(native) ? 1 : 0;
  }
  EXPECT_GT(hits, vector_count / 100);
  EXPECT_LT(hits, vector_count - vector_count / 100);
}

TEST(VendorPipelines, IntSlabsAgreesAt24_24) {
  expect_equal_results<IntSlabs, IntFormat<24, 24>>();
}
TEST(VendorPipelines, IntSlabsAgreesAt20_24) {
  expect_equal_results<IntSlabs, IntFormat<20, 24>>();
}
TEST(VendorPipelines, IntSlabsAgreesAtTheNarrowestFormat) {
  expect_equal_results<IntSlabs, IntFormat<6, 6>>();
}
TEST(VendorPipelines, IntSlabsAgreesAtTheWidestFormat) {
  expect_equal_results<IntSlabs, IntFormat<32, 63>>();
}
TEST(VendorPipelines, IntPluckerAgrees) {
  expect_equal_results<IntPlucker, IntFormat<24, 24>>();
  expect_equal_results<IntPlucker, IntFormat<20, 24>>();
  expect_equal_results<IntPlucker, IntFormat<32, 63>>();
}
TEST(VendorPipelines, FpSlabsAgrees) {
  expect_equal_results<FpSlabs, Fp32>();
}
TEST(VendorPipelines, FpPluckerAgrees) {
  expect_equal_results<FpPlucker, Fp32>();
}

}  // namespace
}  // namespace hitpipe::hls
