// The graph of the saturating shift gives what plain integers give: all numbers of narrow widths, corners of
// wide ones.
#include "hls/num/saturating_shift.hpp"

#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "rtl_gen/graph/trace.hpp"
#include "tests/hls/num/plain_shift.hpp"

namespace hitpipe::rtl::saturating_shift_test {
namespace {

namespace plain = hls::plain;

Graph shift_of(int width) {
  Graph graph("shift");
  const TraceRecorder recorder(graph);
  const Trace::sint x(graph.input("x", width, true));
  const Trace::uint e(graph.input("e", hls::count_bits(width), false));
  const auto shifted = hls::saturating_shift<Trace>(x, e);
  EXPECT_EQ(width_of(shifted), width);
  graph.output("shifted", shifted.id());
  return graph;
}

std::uint64_t pattern(std::int64_t x, int width) {
  return static_cast<std::uint64_t>(x) & ~std::uint64_t{0} >> (64 - width);
}

void expect_plain(const Graph& graph, int width, std::int64_t x, int e) {
  const std::vector<std::uint64_t> in{pattern(x, width), static_cast<std::uint64_t>(e)};
  ASSERT_EQ(evaluate(graph, in).front(), pattern(plain::saturating_shift(x, e, width), width))
      << x << " << " << e << " in " << width << " bits";
}

TEST(SaturatingShiftGraph, IsPlainForEveryNumberOfNarrowWidths) {
  int checked = 0;
  for (int width = 2; width <= 10; ++width) {
    const Graph graph = shift_of(width);
    for (std::int64_t x = plain::least(width); x <= plain::most(width); ++x) {
      for (int e = 0; e < width; ++e, ++checked) ASSERT_NO_FATAL_FAILURE(expect_plain(graph, width, x, e));
    }
  }
  EXPECT_EQ(checked, 9 << 11) << "sum over the widths of W 2^W";
}

TEST(SaturatingShiftGraph, IsPlainForCornersOfWideWidths) {
  int checked = 0;
  for (const int width : {16, 17, 18, 21, 23, 32, 33, 34, 35}) {
    const Graph graph = shift_of(width);
    plain::for_each_corner(width, [&](std::int64_t x) {
      for (int e = 0; e < width; ++e, ++checked) ASSERT_NO_FATAL_FAILURE(expect_plain(graph, width, x, e));
    });
  }
  EXPECT_GT(checked, 50'000);
}

}  // namespace
}  // namespace hitpipe::rtl::saturating_shift_test
