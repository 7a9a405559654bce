// Signals follow the width and sign rules of hls/num; their bits are those of the recorded graph, evaluated.
#include "rtl_gen/graph/trace.hpp"

#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "tests/hls/num/domain_operators.hpp"
#include "tests/message_of.hpp"
#include "tests/rtl_gen/seeded.hpp"

namespace hitpipe::rtl::trace_test {
namespace {

namespace exact = hls::exact;

/// All operators on one pair of operand types, with `vectors` random operands each. Returns the number of
/// results compared.
template <class A, class B>
int compare_pair(Seeded& random, int vectors) {
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

  int compared = 0;
  for (int v = 0; v < vectors; ++v) {
    const std::vector<std::uint64_t> in{random.value(A::width), random.value(B::width)};
    const auto traced = evaluate(graph, in);
    std::size_t i = 0;
    exact::for_each_operator<A, B>([&](const auto& op) {
      EXPECT_EQ(traced[i++], exact::pattern_of(op.apply(hls::Native(), A(in[0]), B(in[1]))))
          << op.name << std::hex << ", a 0x" << in[0] << ":" << std::dec << A::width
          << (A::is_signed ? "s" : "u") << std::hex << ", b 0x" << in[1] << ":" << std::dec << B::width
          << (B::is_signed ? "s" : "u");
      ++compared;
    });
    if (testing::Test::HasFailure()) break;
  }
  return compared;
}

TEST(Signal, EveryOperatorMeansWhatTheHostsDoes) {
  constexpr int vectors = 5000;
  Seeded random(103);
  int pairs = 0;
  exact::for_each_pair_of_types([&]<class A, class B>() {
    ++pairs;
    const int compared = compare_pair<A, B>(random, vectors);
    EXPECT_GE(compared, 20 * vectors);
  });
  EXPECT_EQ(pairs, exact::type_pair_count);
  static_assert(vectors * exact::type_pair_count >= 100000,
                "most operators are compared on that many vectors");
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

TEST(SourceLine, OfTheProjectStartsAtHls) {
  EXPECT_EQ(source_line("/any/where/hls/pipelines/toy.hpp", 33).file, "hls/pipelines/toy.hpp");
  EXPECT_EQ(source_line("hls/pipelines/toy.hpp", 33).file, "hls/pipelines/toy.hpp");
  EXPECT_EQ(source_line("/home/hls/work/hls/num/toy.hpp", 33).file, "hls/num/toy.hpp");
  EXPECT_EQ(source_line("../hls/num/toy.hpp", 33).file, "hls/num/toy.hpp");
  EXPECT_EQ(source_line("hls/toy.hpp", 33).line, 33U);
}

TEST(SourceLine, OfAnyOtherSourceIsItsLastTwoComponents) {
  EXPECT_EQ(source_line("/home/somebody/designs/toy.hpp", 33).file, "designs/toy.hpp");
  EXPECT_EQ(source_line("/home/hls/work/secret/toy.hpp", 33).file, "secret/toy.hpp");
  EXPECT_EQ(source_line("/home/myhls/num/toy.hpp", 33).file, "num/toy.hpp");
  EXPECT_EQ(source_line("/toy.hpp", 33).file, "toy.hpp");
  EXPECT_EQ(source_line("toy.hpp", 33).file, "toy.hpp");
  EXPECT_EQ(source_line("", 33).file, "");
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
  EXPECT_EQ(message_of<std::logic_error>([] { static_cast<void>(Trace::lit(1, 3)); }),
            "a Signal was used while no TraceRecorder is in scope");
}

}  // namespace
}  // namespace hitpipe::rtl::trace_test
