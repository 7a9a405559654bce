// The float operators on widths known at run time give the bits of the native domain: all pairs of small
// formats, random pairs of wide and lopsided ones, all pairs of binary32 corners.
#include "hls/num/sized.hpp"
#include "tests/hls/num/float_check.hpp"

namespace hitpipe::hls::sized_fp_test {
namespace {

template <int E, int M>
exact::FloatCheck check() {
  const FpBits format{E, M};
  return {E, M,
          exact::float_operators<Sized>(
              format, [](std::uint64_t a) { return Sized::uint(a, 1 + E + M); },
              [](const auto& word) { return word.word(); }),
          exact::native_operators<E, M>()};
}

TEST(SizedFloats, EveryPairOfSmallFormatsIsTheNativeOne) {
  check<3, 2>().every_pair();
  check<2, 1>().every_pair();
  check<2, 3>().every_pair();
  check<4, 1>().every_pair();
}

TEST(SizedFloats, RandomPairsAreTheNativeOnes) {
  check<5, 10>().random_pairs(221);
  check<8, 7>().random_pairs(222);
  check<8, 1>().random_pairs(223);
  check<2, 23>().random_pairs(224);
  check<8, 23>().random_pairs(225);
}

TEST(SizedFloats, EveryPairOfBinary32CornersIsTheNativeOne) {
  check<8, 23>().every_pair_of_corners();
}

}  // namespace
}  // namespace hitpipe::hls::sized_fp_test
