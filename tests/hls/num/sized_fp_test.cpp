// The float operators on widths known at run time give the bits of the native domain: all pairs of small
// formats, random pairs of wide and lopsided formats, all pairs of binary32 corners.
#include <cstdint>
#include <iostream>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "hls/box/fp_format.hpp"
#include "hls/num/fp_logic.hpp"
#include "hls/num/sized.hpp"
#include "tests/hls/num/float_corners.hpp"
#include "tests/hls/num/float_operators.hpp"

namespace hitpipe::hls::sized_fp_test {
namespace {

/// Compares the operators of one format on pairs and counts results.
template <int E, int M>
class Check {
 public:
  void pair(std::uint64_t a, std::uint64_t b) {
    const Sized::uint x(a, format_.width());
    const Sized::uint y(b, format_.width());
    one("a - b", a, b, fp_logic::subtract<Sized>(format_, x, y), exact::subtract_bits<E, M>(a, b));
    one("a * b", a, b, fp_logic::multiply<Sized>(format_, x, y), exact::multiply_bits<E, M>(a, b));
    one("compare(a, b)", a, b, fp_logic::compare<Sized>(format_, x, y), exact::compare_bits<E, M>(a, b));
  }

  void finish(std::size_t pairs) const {
    EXPECT_EQ(failed_, 0U);
    EXPECT_EQ(checked_, 3 * pairs);
    std::cout << checked_ << " results checked of E = " << E << ", M = " << M << '\n';
  }

 private:
  void one(const char* operation, std::uint64_t a, std::uint64_t b, const Sized::uint& got,
           std::uint64_t native) {
    ++checked_;
    if (got.word() == native || ++failed_ > 5) return;
    ADD_FAILURE() << "E = " << E << ", M = " << M << std::hex << ": " << operation << ", a 0x" << a
                  << ", b 0x" << b << ", gives 0x" << got.word() << ", natively 0x" << native;
  }

  FpBits format_{E, M};
  std::size_t checked_ = 0;
  std::size_t failed_ = 0;
};

template <int E, int M>
void check_every_pair() {
  constexpr std::uint64_t patterns = std::uint64_t{1} << (1 + E + M);
  Check<E, M> check;
  for (std::uint64_t a = 0; a < patterns; ++a) {
    for (std::uint64_t b = 0; b < patterns; ++b) check.pair(a, b);
  }
  check.finish(patterns * patterns);
}

TEST(SizedFloats, EveryPairOfSmallFormatsIsTheNativeOne) {
  check_every_pair<3, 2>();
  check_every_pair<2, 1>();
  check_every_pair<2, 3>();
  check_every_pair<4, 1>();
}

/// Random patterns; in half of the pairs the exponents are near.
template <int E, int M>
void check_random_pairs(std::uint64_t seed) {
  constexpr std::size_t pairs = 20'000;
  constexpr std::uint64_t mask = (std::uint64_t{1} << (1 + E + M)) - 1;
  std::mt19937_64 random(seed);
  std::cout << "seed " << seed << '\n';
  Check<E, M> check;
  for (std::size_t i = 0; i < pairs; ++i) {
    const std::uint64_t a = random() & mask;
    const std::uint64_t any = random() & mask;
    const std::uint64_t low = (std::uint64_t{1} << (M + random() % 3)) - 1;
    check.pair(a, i % 2 == 0 ? any : a ^ (any & low));
  }
  check.finish(pairs);
}

TEST(SizedFloats, RandomPairsAreTheNativeOnes) {
  check_random_pairs<5, 10>(221);
  check_random_pairs<8, 7>(222);
  check_random_pairs<8, 1>(223);
  check_random_pairs<2, 23>(224);
  check_random_pairs<8, 23>(225);
}

TEST(SizedFloats, EveryPairOfBinary32CornersIsTheNativeOne) {
  const std::vector<std::uint32_t> corners = exact::corner_floats();
  Check<8, 23> check;
  for (const std::uint32_t a : corners) {
    for (const std::uint32_t b : corners) check.pair(a, b);
  }
  check.finish(exact::corner_float_count * exact::corner_float_count);
}

}  // namespace
}  // namespace hitpipe::hls::sized_fp_test
