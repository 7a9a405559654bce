// Float operators that are simplified inside give the same answers for all operands that they can get.
#include <algorithm>
#include <array>
#include <memory>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rtl_gen/graph/trace_fp.hpp"
#include "rtl_gen/prune/prune.hpp"
#include "tests/rtl_gen/seeded.hpp"

namespace hitpipe::rtl::narrow_test {
namespace {

using testing::HasSubstr;

struct Operator {
  const char* name;
  Trace::uint (*call)(const hls::FpBits& format, const Trace::uint& a, const Trace::uint& b);
  int sign_bits;
};

constexpr std::array operators{Operator{"fp_subtract_rz", call_subtract_rz, 1},
                               Operator{"fp_multiply_rz", call_multiply_rz, 0}};

Graph caller(const Operator& what, const hls::FpBits& format) {
  Graph graph("caller");
  const TraceRecorder recorder(graph);
  const int width = what.sign_bits + format.exponent + format.fraction;
  const Trace::uint a(graph.input("a", width, false));
  const Trace::uint b(graph.input("b", width, false));
  graph.output("y", what.call(format, a, b).id());
  return graph;
}

/// Patterns of one sign or of both, from numbers below 2^bits.
PortDemand some_numbers(const std::string& port, int width, Seeded& random) {
  const std::int64_t half = std::int64_t{1} << (width - 1);
  const auto interval = [&] {
    std::int64_t low = random.below(static_cast<int>(half));
    std::int64_t high = random.below(static_cast<int>(half));
    if (low > high) std::swap(low, high);
    return Interval{low, high};
  };
  PortDemand demand{port, {}};
  const int signs = random.between(1, 3);
  if ((signs & 1) != 0) demand.within.push_back(interval());
  if ((signs & 2) != 0) {
    const auto [low, high] = interval();
    demand.within.push_back({half + low, half + high});
  }
  return demand;
}

std::vector<std::int64_t> numbers_of(const PortDemand& demand) {
  std::vector<std::int64_t> numbers;
  for (const Interval& each : demand.within)
    for (std::int64_t number = each.low; number <= each.high; ++number) numbers.push_back(number);
  return numbers;
}

TEST(NarrowUnits, AnswerAsBeforeForAllOperandsAsDemanded) {
  Seeded random(1807);
  int cut = 0;
  int compared = 0;
  for (const Operator& what : operators) {
    for (const hls::FpBits& format : {hls::FpBits{3, 2}, hls::FpBits{2, 3}}) {
      const Graph whole = caller(what, format);
      const int width = whole[whole.inputs()[0]].width;
      for (int round = 0; round < 12; ++round) {
        const Demands demands{{some_numbers("a", width, random), some_numbers("b", width, random)}};
        const Graph narrowed = simplified(whole, demands);
        cut += to_text(narrowed).find("_cut1") != std::string::npos ? 1 : 0;
        for (const std::int64_t a : numbers_of(demands.ports[0])) {
          for (const std::int64_t b : numbers_of(demands.ports[1])) {
            const std::array operands{static_cast<std::uint64_t>(a), static_cast<std::uint64_t>(b)};
            ASSERT_EQ(evaluate(narrowed, operands), evaluate(whole, operands))
                << what.name << ' ' << a << ' ' << b << ' ' << demand_text(demands, 0) << ", "
                << demand_text(demands, 1);
            ++compared;
          }
        }
      }
    }
  }
  EXPECT_GT(cut, 24);
  EXPECT_GT(compared, 5'000);
}

TEST(NarrowUnits, AskTheLibraryForTheBitsThatChange) {
  const hls::FpBits format{5, 10};
  const Graph whole = caller(operators[0], format);
  // The top exponent bit is 0, the sign is any.
  const std::vector<Interval> below_two{{0, 0x3fff}, {0x8000, 0xbfff}};
  const Graph narrowed = simplified(whole, {{{"a", below_two}, {"b", below_two}}});
  ASSERT_EQ(narrowed.submodules().size(), 1U);
  EXPECT_EQ(narrowed.submodules()[0]->bits, 15);
  EXPECT_EQ(narrowed.submodules()[0]->component, "fp_subtract_rz");
  EXPECT_EQ(narrowed.submodules()[0]->body.name(), "fp_subtract_rz_5_10_cut1");
  EXPECT_LT(size_of(narrowed.submodules()[0]->body).bits, size_of(whole.submodules()[0]->body).bits);
  // One operand that can be anything keeps the width.
  const Graph half = simplified(whole, {{{"a", below_two}}});
  EXPECT_EQ(half.submodules().at(0)->bits, 16);
}

TEST(NarrowUnits, LeaveAProductItsSignificands) {
  const hls::FpBits format{5, 10};
  const Graph whole = caller(operators[1], format);
  const Graph narrowed = simplified(whole, {{{"a", {{0, 0x3fff}}}, {"b", {{0x3c00, 0x3fff}}}}});
  EXPECT_THAT(narrowed.submodules().at(0)->body.name(), HasSubstr("fp_multiply_rz_5_10_cut"));
  EXPECT_EQ(narrowed.submodules().at(0)->bits, 11);
}

TEST(NarrowUnits, StayWholeWhereNothingIsKnown) {
  const Graph whole = caller(operators[0], {5, 10});
  EXPECT_EQ(simplified(whole, {}).submodules().at(0), whole.submodules().at(0));
}

TEST(NarrowUnits, BecomeWiresWhereOnlyWiresAreLeft) {
  Graph body("masked");
  const NodeId word = body.input("a", 8, false);
  body.output("y", body.binary(Op::bit_and, word, body.input("b", 8, false)));
  const auto unit = std::make_shared<const Submodule>(Submodule{"fp_compare", 8, body});
  Graph graph("caller");
  const std::array operands{graph.input("a", 8, false), graph.input("b", 8, false)};
  graph.output("y", graph.call(unit, operands));
  const Graph narrowed = simplified(graph, {{{"b", {{255, 255}}}}});
  EXPECT_TRUE(narrowed.submodules().empty());
  EXPECT_EQ(narrowed.outputs()[0].node, narrowed.inputs()[0]);
}

}  // namespace
}  // namespace hitpipe::rtl::narrow_test
