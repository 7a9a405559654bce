// One C++ source with two meanings that must agree: the pipeline run on the host, and the graph that it
// records.
#include "rtl_gen/catalogue/native.hpp"

#include <gtest/gtest.h>

#include "hls/pipelines/fp_plucker.hpp"
#include "hls/pipelines/fp_slabs.hpp"
#include "hls/pipelines/int_major.hpp"
#include "hls/pipelines/int_plucker.hpp"
#include "hls/pipelines/int_slabs.hpp"
#include "rtl_gen/catalogue/traced.hpp"
#include "rtl_gen/emit/vectors.hpp"
#include "rtl_gen/graph/canonical.hpp"
#include "tests/rtl_gen/catalogue/formats.hpp"
#include "tests/rtl_gen/seeded.hpp"

namespace hitpipe::rtl::native_test {
namespace {

class NativeAndTraced : public testing::TestWithParam<DesignFormat> {};

TEST_P(NativeAndTraced, AgreeOnEveryVector) {
  const Design& design = GetParam().found();
  const Format format = GetParam().parsed();
  const Evaluate native = design.evaluate(format);
  const Graph graph = canonical(design.trace(format));
  // Float units are graphs inside the graph, so evaluating them is slow.
  const int vectors = !design.conservative ? 2000 : 25000;
  DrawVectors draw(input_ports(graph), {}, native, 157);
  auto operands = operand_vectors(input_ports(graph), vectors, 158);
  for (int i = 0; i < vectors; ++i) operands.push_back(draw().operands);
  int hits = 0;
  const std::vector<hls::Result> stated = design.results(format);
  std::vector<std::int64_t> results(stated.size());
  for (const auto& v : operands) {
    native(v.data(), results.data());
    const std::vector<std::uint64_t> in(v.begin(), v.end());
    ASSERT_EQ(patterns_of(evaluate(graph, in), stated), patterns_of(results, stated))
        << testing::PrintToString(v);
    hits += native.yes(results.data()) ? 1 : 0;
  }
  EXPECT_GT(hits, vectors / 4);
  EXPECT_LT(hits, 2 * vectors - vectors / 4);
}

INSTANTIATE_TEST_SUITE_P(Designs, NativeAndTraced,
                         testing::ValuesIn(every_design({"24/24", "20/24", "20/20", "16/16", "16/24", "12/12",
                                                         "12/6", "6/6", "6/11", "32/6", "32/32", "32/63"},
                                                        {"20+1/13", "16+0/8", "6+0/4", "12+2/10f1",
                                                         "8+3/6f-1", "32+3/28", "16+0/4f3", "32+0/31"})),
                         design_suffix);

TEST(Native, BitsAboveAPortsWidthAreIgnored) {
  const Evaluate native = find_design("int_slabs").evaluate(hls::IntBits{6, 6});
  const Graph graph = find_design("int_slabs").trace(hls::IntBits{6, 6});
  Seeded random(163);
  for (const auto& v : operand_vectors(input_ports(graph), 2000, 9)) {
    std::vector<std::int64_t> noisy = v;
    for (std::size_t i = 0; i < v.size(); ++i)
      noisy[i] ^= static_cast<std::int64_t>(random.bits() << graph[graph.inputs()[i]].width);
    ASSERT_EQ(native(noisy.data()), native(v.data()));
  }
}

/// Graph and host function of a format chosen at run time.
template <class Pipeline>
void expect_graph_agrees(const typename Pipeline::Bits& bits, int vectors, int& hits) {
  const Graph graph = traced<Pipeline>(bits);
  for (const auto& v : operand_vectors(input_ports(graph), vectors, 321)) {
    std::int64_t hit = -1;
    native_function<Pipeline>(bits)(bits, v.data(), &hit);
    const std::vector<std::uint64_t> in(v.begin(), v.end());
    ASSERT_EQ(static_cast<std::uint64_t>(hit), evaluate(graph, in).front());
    hits += hit == 1 ? 1 : 0;
  }
}

TEST(AnyFormat, EveryIntegerFormatHasTheGraphOfItsAnswers) {
  constexpr int vectors = 60;
  int formats = 0;
  int slabs_hits = 0;
  int plucker_hits = 0;
  for (int n = hls::IntBits::min_coord; n <= hls::IntBits::max_coord; ++n) {
    for (int t = hls::IntBits::min_interval; t < 2 * n; ++t, ++formats) {
      SCOPED_TRACE(to_string(Format(hls::IntBits{n, t})));
      ASSERT_NO_FATAL_FAILURE(expect_graph_agrees<hls::IntSlabs>(hls::IntBits{n, t}, vectors, slabs_hits));
      ASSERT_NO_FATAL_FAILURE(expect_graph_agrees<hls::IntPlucker>({n, t}, vectors, plucker_hits));
    }
  }
  EXPECT_EQ(formats, 864);
  EXPECT_GT(slabs_hits, formats * vectors / 200);
  EXPECT_GT(plucker_hits, formats * vectors / 200);
}

/// All n, g and F; p in turn.
TEST(AnyFormat, EveryMajorAxisFormatHasTheGraphOfItsAnswers) {
  constexpr int vectors = 10;
  int formats = 0;
  int hits = 0;
  for (int n = hls::MajorBits::min_proved_coord; n <= hls::MajorBits::max_coord; ++n)
    for (int g = 0; g <= hls::MajorBits::max_finer; ++g)
      for (int f = hls::MajorBits::min_fraction; f <= hls::MajorBits::max_fraction; ++f) {
        const hls::MajorBits bits{n, g, 4 + formats++ % 25, f};
        ASSERT_TRUE(bits.proved());
        SCOPED_TRACE(to_string(Format(bits)));
        ASSERT_NO_FATAL_FAILURE(expect_graph_agrees<hls::IntMajor>(bits, vectors, hits));
      }
  EXPECT_EQ(formats, 29 * 4 * 6);
  EXPECT_GT(hits, formats * vectors / 200);
  EXPECT_LT(hits, formats * vectors / 2);
}

TEST(AnyFormat, FloatsOfAnyWidthHaveTheGraphOfTheirAnswers) {
  for (const hls::FpBits bits : {hls::FpBits{3, 2}, hls::FpBits{2, 1}, hls::FpBits{5, 10}, hls::FpBits{8, 7},
                                 hls::FpBits{2, 23}, hls::FpBits{8, 1}}) {
    int hits = 0;
    SCOPED_TRACE(to_string(Format(bits)));
    ASSERT_NO_FATAL_FAILURE(expect_graph_agrees<hls::FpSlabs>(bits, 200, hits));
    ASSERT_NO_FATAL_FAILURE(expect_graph_agrees<hls::FpPlucker>(bits, 200, hits));
    EXPECT_GT(hits, 0);
  }
}

TEST(BuiltInFormat, HasAnInstanceOfItsOwn) {
  const Evaluate::Run any = detail::run_any<hls::IntSlabs>;
  EXPECT_NE(native_function<hls::IntSlabs>({20, 24}), any);
  EXPECT_EQ(native_function<hls::IntSlabs>({20, 23}), any);
  const Evaluate::Run any_major = detail::run_any<hls::IntMajor>;
  EXPECT_NE(native_function<hls::IntMajor>(hls::MajorBits{}), any_major) << "the default format";
  EXPECT_EQ(native_function<hls::IntMajor>({20, 1, 13, 1}), any_major);
}

}  // namespace
}  // namespace hitpipe::rtl::native_test
