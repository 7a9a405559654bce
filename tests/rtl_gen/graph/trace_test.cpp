// Signals follow the width and sign rules of hls/num; the recorded graph, evaluated, gives their bits. Float
// operators as recorded and in canonical form give the bits of the native domain.
#include "rtl_gen/graph/trace.hpp"

#include <cstddef>
#include <functional>
#include <iostream>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "hls/box/fp_format.hpp"
#include "hls/num/fp_logic.hpp"
#include "rtl_gen/graph/canonical.hpp"
#include "tests/hls/num/domain_operators.hpp"
#include "tests/hls/num/float_check.hpp"
#include "tests/message_of.hpp"
#include "tests/rtl_gen/seeded.hpp"

namespace hitpipe::rtl::trace_test {
namespace {

namespace exact = hls::exact;

/// All operators on one pair of operand types, with `vectors` random operands each.
template <class A, class B>
void compare_pair(Seeded& random, int vectors) {
  Graph graph("pair");
  const TraceRecorder recorder(graph);
  const Signal<A::is_signed> a(graph.input("a", A::width, A::is_signed));
  const Signal<B::is_signed> b(graph.input("b", B::width, B::is_signed));
  exact::for_each_operator<A, B>([&]<class Op>(const Op& op) {
    const auto traced = op.apply(Trace(), a, b);
    using Native = exact::NativeResult<Op, A, B>;
    static_assert(decltype(traced)::is_signed == Native::is_signed);
    EXPECT_EQ(width_of(traced), Native::width) << op.name;
    graph.output(op.name, traced.id());
  });
  EXPECT_GE(graph.outputs().size(), 20U);
  const auto described = [](auto word, int width, bool is_signed) {
    return fmt::format("{:#x}:{}{}", word, width, is_signed ? "s" : "u");
  };
  for (int v = 0; v < vectors && !testing::Test::HasFailure(); ++v) {
    const std::vector<std::uint64_t> in{random.value(A::width), random.value(B::width)};
    const auto traced = evaluate(graph, in);
    std::size_t i = 0;
    exact::for_each_operator<A, B>([&](const auto& op) {
      EXPECT_EQ(traced[i++], exact::pattern_of(op.apply(hls::Native(), A(in[0]), B(in[1]))))
          << op.name << ", a " << described(in[0], A::width, A::is_signed) << ", b "
          << described(in[1], B::width, B::is_signed);
    });
  }
}

TEST(Signal, EveryOperatorMeansWhatTheHostsDoes) {
  constexpr int vectors = 5000;
  Seeded random(103);
  int pairs = 0;
  exact::for_each_pair_of_types([&]<class A, class B>() {
    ++pairs;
    compare_pair<A, B>(random, vectors);
  });
  EXPECT_EQ(pairs, exact::type_pair_count);
}

TEST(Signal, ExtendsByTheSignOfItsSource) {
  Graph graph("conversion");
  const TraceRecorder recorder(graph);
  const Trace::uint positive(graph.input("u", 4, false));
  const Trace::sint negative(graph.input("s", 4, true));
  graph.output("u_to_s", as_signed(resize(positive, 8)).id());
  graph.output("s_to_u", as_unsigned(resize(negative, 8)).id());
  EXPECT_EQ(evaluate(graph, std::vector<std::uint64_t>{0x9, 0x9}), (std::vector<std::uint64_t>{0x09, 0xf9}));
}

TEST(Signal, NamesLandOnTheValue) {
  Graph graph("names");
  const TraceRecorder recorder(graph);
  const Trace::sint a(graph.input("a", 4, true));
  const auto sum = as("sum", a + a);
  const auto next = as("d", 'y', a - a);
  EXPECT_EQ(graph[sum.id()].source.line, static_cast<unsigned>(__LINE__) - 2) << "where as() is called";
  EXPECT_EQ(graph[sum.id()].source.file, source_line(__FILE__, 0).file);
  EXPECT_EQ(graph[sum.id()].name, "sum");
  EXPECT_EQ(graph[next.id()].name, "d_y");
  EXPECT_EQ(graph[next.id()].source.line, graph[sum.id()].source.line + 1);
}

TEST(SourceLine, OfTheProjectStartsAtHlsAndOfAnyOtherIsItsLastTwoComponents) {
  const std::pair<const char*, const char*> cases[] = {
      {"/any/where/hls/pipelines/toy.hpp", "hls/pipelines/toy.hpp"},
      {"hls/pipelines/toy.hpp", "hls/pipelines/toy.hpp"},
      {"/home/hls/work/hls/num/toy.hpp", "hls/num/toy.hpp"},
      {"../hls/num/toy.hpp", "hls/num/toy.hpp"},
      {"/home/somebody/designs/toy.hpp", "designs/toy.hpp"},
      {"/home/hls/work/secret/toy.hpp", "secret/toy.hpp"},
      {"/home/myhls/num/toy.hpp", "num/toy.hpp"},
      {"/toy.hpp", "toy.hpp"},
      {"toy.hpp", "toy.hpp"},
      {"", ""}};
  for (const auto& [path, shown] : cases) {
    EXPECT_EQ(source_line(path, 33).file, shown);
    EXPECT_EQ(source_line(path, 33).line, 33U);
  }
}

TEST(TraceRecorder, TheInnerOneRecordsUntilItEnds) {
  Graph outer("outer");
  Graph inner("inner");
  const TraceRecorder first(outer);
  {
    const TraceRecorder second(inner);
    EXPECT_EQ(&TraceRecorder::graph(), &inner);
  }
  EXPECT_EQ(&TraceRecorder::graph(), &outer);
}

TEST(TraceRecorder, SignalWithoutRecorderRejected) {
  EXPECT_EQ(message_of<std::logic_error>([] { return Trace::lit(1, 3); }),
            "a Signal was used while no TraceRecorder is in scope");
}

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
  const exact::FloatOperators native = exact::native_operators<E, M>();
  return {
      traced("subtract", {E, M}, native.subtract, hls::fp_logic::subtract<Trace, FpBits, Bits>),
      traced("multiply", {E, M}, native.multiply, hls::fp_logic::multiply<Trace, FpBits, Bits>),
      traced("compare", {E, M}, native.compare, hls::fp_logic::compare<Trace, FpBits, Bits>),
  };
}

/// `next` gives one pair after another.
void expect_native(const std::vector<TracedOperator>& operators, std::size_t pairs,
                   const std::function<std::vector<std::uint64_t>(std::size_t)>& next) {
  for (std::size_t i = 0; i < pairs; ++i) {
    const std::vector<std::uint64_t> in = next(i);
    for (const TracedOperator& op : operators)
      for (const Graph* const graph : {&op.recorded, &op.canonical})
        ASSERT_EQ(evaluate(*graph, in).front(), op.native(in[0], in[1]))
            << graph->name() << (graph == &op.canonical ? " canonical" : "") << std::hex << ", a 0x" << in[0]
            << ", b 0x" << in[1];
  }
}

TEST(TracedFloats, EveryPairOfCornersIsTheNativeOne) {
  const std::vector<std::uint32_t> corners = exact::corner_floats();
  ASSERT_EQ(corners.size(), exact::corner_float_count);
  const auto next = [&](std::size_t i) {
    return std::vector<std::uint64_t>{corners[i / corners.size()], corners[i % corners.size()]};
  };
  expect_native(traced_operators<8, 23>(), corners.size() * corners.size(), next);
}

TEST(TracedFloats, RandomPairsAreTheNativeOnes) {
  constexpr std::uint64_t seed = 131;
  std::cout << "seed " << seed << '\n';
  exact::FloatPairs random(seed);
  const auto next = [&](std::size_t) {
    const exact::FloatPair p = random.next();
    return std::vector<std::uint64_t>{p.a, p.b};
  };
  expect_native(traced_operators<8, 23>(), 50'000, next);
}

TEST(TracedFloats, EveryPairOfASmallFormatIsTheNativeOne) {
  constexpr std::size_t patterns = 64;
  const auto next = [](std::size_t i) { return std::vector<std::uint64_t>{i / patterns, i % patterns}; };
  expect_native(traced_operators<3, 2>(), patterns * patterns, next);
}

template <int E, int M>
void check_format(std::uint64_t seed) {
  SCOPED_TRACE("E = " + std::to_string(E) + ", M = " + std::to_string(M));
  Seeded random(seed);
  const auto next = [&](std::size_t) {
    const std::uint64_t a = random.value(1 + E + M);
    return std::vector<std::uint64_t>{a, random.value(1 + E + M)};
  };
  expect_native(traced_operators<E, M>(), 5'000, next);
}

TEST(TracedFloats, OtherFormatsAreTheNativeOnes) {
  check_format<4, 3>(132);
  check_format<2, 1>(133);
  check_format<2, 23>(134);
  check_format<8, 1>(135);
  check_format<5, 10>(136);
}

TEST(CheckPorts, NamesAPortThatIsTooWide) {
  Graph graph("broad");
  const NodeId a = graph.input("a", 64, false);
  graph.output("sum", graph.extend(a, 64, false));
  EXPECT_NO_THROW(check_ports(graph));
  graph.output("product", graph.extend(a, 65, false));
  EXPECT_EQ(message_of<std::runtime_error>([&] { check_ports(graph); }),
            "design broad: port product has 65 bits, allowed are 1 to 64; make it two ports");
}

}  // namespace
}  // namespace hitpipe::rtl::trace_test
