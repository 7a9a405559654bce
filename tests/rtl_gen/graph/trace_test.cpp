// Signals follow the width and sign rules of hls/num: types by static_assert, bits by evaluating what was
// recorded.
#include "rtl_gen/graph/trace.hpp"

#include <stdexcept>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "hls/num/domain.hpp"
#include "tests/message_of.hpp"
#include "tests/rtl_gen/seeded.hpp"

namespace hitpipe::rtl {
namespace {

template <class Op>
struct Named {
  const char* name;
  Op apply;  ///< of a domain and two of its values
};
template <class Op>
Named(const char*, Op) -> Named<Op>;

// clang-format off
constexpr auto all_operators = std::make_tuple(
    Named{"a + b", [](auto, const auto& a, const auto& b) { return a + b; }},
    Named{"a - b", [](auto, const auto& a, const auto& b) { return a - b; }},
    Named{"a * b", [](auto, const auto& a, const auto& b) { return a * b; }},
    Named{"a & b", [](auto, const auto& a, const auto& b) { return a & b; }},
    Named{"a | b", [](auto, const auto& a, const auto& b) { return a | b; }},
    Named{"a ^ b", [](auto, const auto& a, const auto& b) { return a ^ b; }},
    Named{"~a", [](auto, const auto& a, const auto&) { return ~a; }},
    Named{"a < b", [](auto, const auto& a, const auto& b) { return a < b; }},
    Named{"a > b", [](auto, const auto& a, const auto& b) { return a > b; }},
    Named{"a <= b", [](auto, const auto& a, const auto& b) { return a <= b; }},
    Named{"a >= b", [](auto, const auto& a, const auto& b) { return a >= b; }},
    Named{"a == b", [](auto, const auto& a, const auto& b) { return a == b; }},
    Named{"a != b", [](auto, const auto& a, const auto& b) { return a != b; }},
    Named{"slice", []<class A>(auto, const A& a, const auto&) { return slice<A::width - 1, A::width / 2>(a); }},
    Named{"cat", [](auto, const auto& a, const auto& b) { return cat(a, b); }},
    Named{"select", []<class D, class A>(D, const A& a, const auto& b) {
      return select(typename D::bit(a < b), a, A(b)); }},
    Named{"resize up", [](auto, const auto& a, const auto&) { return resize<50>(a); }},
    Named{"resize down", []<class A>(auto, const A& a, const auto&) { return resize<(A::width + 1) / 2>(a); }},
    Named{"to sint", []<class D>(D, const auto& a, const auto&) { return typename D::template sint<37>(a); }},
    Named{"to uint", []<class D>(D, const auto& a, const auto&) { return typename D::template uint<37>(a); }},
    Named{"to b", []<class B>(auto, const auto& a, const B&) { return B(a); }},
    Named{"lit", []<class D>(D, const auto& a, const auto&) { return a + hls::lit<5, D>(0x33); }},
    Named{"sint of -3", []<class D>(D, const auto& a, const auto&) { return a - typename D::template sint<7>(-3); }},
    Named{"as", [](auto, const auto& a, const auto& b) { return as("named", a) - as("named", 'x', b); }});
// clang-format on
constexpr std::size_t operator_count = std::tuple_size_v<decltype(all_operators)>;

template <class T>
struct Shape {
  static constexpr int width = T::width;
  static constexpr bool is_signed = T::is_signed;
};
template <>
struct Shape<bool> {
  static constexpr int width = 1;
  static constexpr bool is_signed = false;
};

template <class T>
std::uint64_t pattern_of(const T& x) {
  return x.to_uint64() & ~std::uint64_t{0} >> (64 - T::width);
}
std::uint64_t pattern_of(bool x) {
  return x ? 1 : 0;
}

/// All operators on one pair of operand types, `vectors` random operands each; the number of results
/// compared.
template <int W1, bool S1, int W2, bool S2>
int compare_pair(Seeded& random, int vectors) {
  using A = hls::ap_base<W1, S1>;
  using B = hls::ap_base<W2, S2>;
  Graph graph("pair");
  const Tracer tracer(graph);
  const auto a = Signal<W1, S1>::from(graph.input("a", W1, S1));
  const auto b = Signal<W2, S2>::from(graph.input("b", W2, S2));
  const auto record = [&]<class Op>(const Named<Op>& op) {
    const auto traced = op.apply(Trace{}, a, b);
    using Traced = std::decay_t<decltype(traced)>;
    using Native = std::decay_t<decltype(op.apply(hls::Native{}, A{}, B{}))>;
    static_assert(Traced::width == Shape<Native>::width);
    static_assert(Traced::is_signed == Shape<Native>::is_signed);
    EXPECT_EQ(graph[traced.id()].width, Traced::width) << op.name;
    graph.output(op.name, traced.id());
  };
  std::apply([&](const auto&... op) { (record(op), ...); }, all_operators);

  int compared = 0;
  for (int v = 0; v < vectors; ++v) {
    const std::vector<std::uint64_t> in{random.value(W1), random.value(W2)};
    const auto traced = evaluate(graph, in);
    std::vector<std::uint64_t> native;
    std::apply(
        [&](const auto&... op) {
          (native.push_back(pattern_of(op.apply(hls::Native{}, A(in[0]), B(in[1])))), ...);
        },
        all_operators);
    for (std::size_t i = 0; i < operator_count; ++i) {
      EXPECT_EQ(traced[i], native[i])
          << graph.outputs()[i].name << std::hex << ", a 0x" << in[0] << ":" << std::dec << W1
          << (S1 ? "s" : "u") << std::hex << ", b 0x" << in[1] << ":" << std::dec << W2 << (S2 ? "s" : "u");
      ++compared;
    }
    if (testing::Test::HasFailure()) break;
  }
  return compared;
}

TEST(Signal, EveryOperatorMeansWhatTheHostsDoes) {
  constexpr int vectors = 5000;
  constexpr int pairs = 20;
  constexpr bool u = false;
  constexpr bool s = true;
  Seeded random(103);
  int compared = 0;
  compared += compare_pair<1, u, 1, u>(random, vectors);
  compared += compare_pair<1, s, 1, s>(random, vectors);
  compared += compare_pair<1, u, 1, s>(random, vectors);
  compared += compare_pair<1, s, 1, u>(random, vectors);
  compared += compare_pair<2, s, 5, u>(random, vectors);
  compared += compare_pair<5, u, 2, s>(random, vectors);
  compared += compare_pair<8, s, 8, s>(random, vectors);
  compared += compare_pair<8, u, 8, u>(random, vectors);
  compared += compare_pair<8, s, 8, u>(random, vectors);
  compared += compare_pair<7, u, 13, s>(random, vectors);
  compared += compare_pair<13, s, 7, u>(random, vectors);
  compared += compare_pair<24, s, 24, s>(random, vectors);
  compared += compare_pair<24, u, 20, s>(random, vectors);
  compared += compare_pair<20, s, 24, u>(random, vectors);
  compared += compare_pair<31, u, 31, u>(random, vectors);
  compared += compare_pair<32, s, 32, s>(random, vectors);
  compared += compare_pair<32, u, 31, s>(random, vectors);
  compared += compare_pair<3, s, 30, s>(random, vectors);
  compared += compare_pair<30, u, 3, u>(random, vectors);
  compared += compare_pair<16, u, 33, s>(random, vectors);
  EXPECT_EQ(compared, vectors * pairs * static_cast<int>(operator_count));
  static_assert(vectors * pairs >= 100000, "each operator is compared on that many vectors");
}

TEST(Signal, ExtendsByTheSignOfItsSource) {
  Graph graph("conversion");
  const Tracer tracer(graph);
  const auto positive = Signal<4, false>::from(graph.input("u", 4, false));
  const auto negative = Signal<4, true>::from(graph.input("s", 4, true));
  graph.output("u_to_s", Signal<8, true>(positive).id());
  graph.output("s_to_u", Signal<8, false>(negative).id());
  EXPECT_EQ(evaluate(graph, std::vector<std::uint64_t>{0x9, 0x9}), (std::vector<std::uint64_t>{0x09, 0xf9}));
}

TEST(Signal, NamesLandOnTheValue) {
  Graph graph("names");
  const Tracer tracer(graph);
  const auto a = Signal<4, true>::from(graph.input("a", 4, true));
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

TEST(Tracer, TheInnerOneRecordsUntilItEnds) {
  Graph outer("outer");
  Graph inner("inner");
  const Tracer first(outer);
  {
    const Tracer second(inner);
    EXPECT_EQ(&Tracer::graph(), &inner);
  }
  EXPECT_EQ(&Tracer::graph(), &outer);
}

TEST(Tracer, SignalWithoutTracerRejected) {
  EXPECT_EQ(message_of<std::logic_error>([] { static_cast<void>(Signal<3, false>(1)); }),
            "a Signal was used while no Tracer is in scope");
}

}  // namespace
}  // namespace hitpipe::rtl
