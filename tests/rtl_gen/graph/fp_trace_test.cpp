// The traced float operators: their graphs, as recorded and in canonical form, give the bits of the native
// domain on every pair of binary32 corners and on random pairs.
#include <cstddef>
#include <functional>
#include <iostream>
#include <vector>

#include <gtest/gtest.h>

#include "hls/box/fp_format.hpp"
#include "hls/num/fp_logic.hpp"
#include "rtl_gen/graph/canonical.hpp"
#include "rtl_gen/graph/trace.hpp"
#include "tests/hls/num/float_corners.hpp"
#include "tests/hls/num/float_operators.hpp"
#include "tests/rtl_gen/seeded.hpp"

namespace hitpipe::rtl::fp_trace_test {
namespace {

namespace exact = hls::exact;

struct TracedOperator {
  Graph recorded;
  Graph canonical;
  exact::FloatOperator native;
};

template <class Logic>
TracedOperator traced(const char* name, hls::FpBits format, exact::FloatOperator native, Logic logic) {
  Graph graph(name);
  const TraceRecorder recorder(graph);
  const Trace::uint a(graph.input("a", format.width(), false));
  const Trace::uint b(graph.input("b", format.width(), false));
  graph.output("result", logic(format, a, b).id());
  return {graph, canonical(graph), native};
}

template <int E, int M>
std::vector<TracedOperator> traced_operators() {
  using hls::FpBits;
  using Bits = Trace::uint;
  return {
      traced("subtract", {E, M}, exact::subtract_bits<E, M>, hls::fp_logic::subtract<Trace, FpBits, Bits>),
      traced("multiply", {E, M}, exact::multiply_bits<E, M>, hls::fp_logic::multiply<Trace, FpBits, Bits>),
      traced("compare", {E, M}, exact::compare_bits<E, M>, hls::fp_logic::compare<Trace, FpBits, Bits>),
  };
}

/// `next` gives one pair after another. Returns the number of results compared.
std::size_t compare(const std::vector<TracedOperator>& operators, std::size_t pairs,
                    const std::function<std::vector<std::uint64_t>()>& next) {
  std::size_t compared = 0;
  for (std::size_t i = 0; i < pairs; ++i) {
    const std::vector<std::uint64_t> in = next();
    for (const TracedOperator& op : operators) {
      const std::uint64_t native = op.native(in[0], in[1]);
      const std::uint64_t recorded = evaluate(op.recorded, in).front();
      const std::uint64_t reduced = evaluate(op.canonical, in).front();
      compared += 2;
      if (recorded == native && reduced == native) continue;
      ADD_FAILURE() << op.recorded.name() << std::hex << ", a 0x" << in[0] << ", b 0x" << in[1]
                    << ": native 0x" << native << ", recorded 0x" << recorded << ", canonical 0x" << reduced;
      return compared;
    }
  }
  return compared;
}

TEST(TracedFloats, EveryPairOfCornersIsTheNativeOne) {
  const std::vector<std::uint32_t> corners = exact::corner_floats();
  std::size_t at = 0;
  const auto next = [&] {
    const std::size_t i = at++;
    return std::vector<std::uint64_t>{corners[i / corners.size()], corners[i % corners.size()]};
  };
  const std::size_t pairs = exact::corner_float_count * exact::corner_float_count;
  EXPECT_EQ(compare(traced_operators<8, 23>(), pairs, next), 6 * pairs);
}

TEST(TracedFloats, RandomPairsAreTheNativeOnes) {
  constexpr std::uint64_t seed = 131;
  constexpr std::size_t pairs = 50'000;
  std::cout << "seed " << seed << '\n';
  exact::FloatPairs random(seed);
  const auto next = [&] {
    const exact::FloatPair p = random.next();
    return std::vector<std::uint64_t>{p.a, p.b};
  };
  EXPECT_EQ(compare(traced_operators<8, 23>(), pairs, next), 6 * pairs);
}

TEST(TracedFloats, EveryPairOfASmallFormatIsTheNativeOne) {
  constexpr std::size_t patterns = 64;
  std::size_t at = 0;
  const auto next = [&] {
    const std::size_t i = at++;
    return std::vector<std::uint64_t>{i / patterns, i % patterns};
  };
  EXPECT_EQ((compare(traced_operators<3, 2>(), patterns * patterns, next)), 6 * patterns * patterns);
}

template <int E, int M>
void check_format(std::uint64_t seed) {
  constexpr std::size_t pairs = 5'000;
  Seeded random(seed);
  const auto next = [&] {
    const std::uint64_t a = random.value(1 + E + M);
    return std::vector<std::uint64_t>{a, random.value(1 + E + M)};
  };
  EXPECT_EQ(compare(traced_operators<E, M>(), pairs, next), 6 * pairs) << "E = " << E << ", M = " << M;
}

TEST(TracedFloats, OtherFormatsAreTheNativeOnes) {
  check_format<4, 3>(132);
  check_format<2, 1>(133);
  check_format<2, 23>(134);
  check_format<8, 1>(135);
  check_format<5, 10>(136);
}

}  // namespace
}  // namespace hitpipe::rtl::fp_trace_test
