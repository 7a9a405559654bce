// The float operators in the vendor's domain against the native one, on every pair of binary32 corners and on
// random pairs. Built only where HITPIPE_VENDOR_AP_INT names a folder with the vendor's ap_int.h.
#include "hls/num/vendor.hpp"
#include "tests/hls/num/float_check.hpp"

namespace hitpipe::hls {
namespace {

exact::FloatCheck vendor_check() {
  return {8, 23,
          exact::float_operators<Vendor>(
              Fp32(), [](std::uint64_t a) { return Vendor::uint<32>(static_cast<std::uint32_t>(a)); },
              [](const auto& word) { return static_cast<std::uint64_t>(word.to_uint64()); }),
          exact::native_operators<8, 23>()};
}

TEST(VendorFloats, EveryPairOfCornersIsTheNativeOne) {
  vendor_check().every_pair_of_corners();
}

TEST(VendorFloats, RandomPairsAreTheNativeOnes) {
  vendor_check().random_floats(91, 20'000);
}

}  // namespace
}  // namespace hitpipe::hls
