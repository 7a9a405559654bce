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

/// Operands as a ray set-up gives them: a grid with a margin, a box of some size, floor and ceiling of an
/// IRDVC.
std::vector<std::int64_t> ray_and_box(Seeded& random, hls::IntBits bits) {
  const std::int64_t grid = (std::int64_t{1} << (bits.coord - 2)) - 1;
  const auto on_grid = [&] {
    return static_cast<std::int64_t>(random.bits() % static_cast<std::uint64_t>(2 * grid + 1)) - grid;
  };
  const std::int64_t slope = 2 * grid;
  std::vector<std::int64_t> v{on_grid(), on_grid(), on_grid()};
  v.push_back(static_cast<std::int64_t>(random.value(bits.interval - 1)));
  for (int axis = 0; axis < 3; ++axis) {
    const std::int64_t floor = on_grid() * 2 % slope;
    v.push_back(floor);
    v.push_back(floor + (random.flip() ? 1 : 0));
  }
  v.push_back(random.flip() ? 1 : 0);
  for (int axis = 0; axis < 3; ++axis) {
    const std::int64_t one = on_grid();
    const std::int64_t two = on_grid();
    v.push_back(std::min(one, two));
    v.push_back(std::max(one, two));
  }
  return v;
}

class NativeAndTraced : public testing::TestWithParam<DesignFormat> {};

TEST_P(NativeAndTraced, AgreeOnEveryVector) {
  const Design& design = GetParam().found();
  const Format format = GetParam().parsed();
  const Evaluate native = design.evaluate(format);
  const Graph graph = canonical(design.trace(format));
  Seeded random(157);
  // Corners and random bits. For integer slabs also as many rays and boxes; many of these hit.
  const bool with_rays = design.name == "int_slabs";
  // Float units are graphs inside the graph, so evaluating them is slow.
  const std::size_t vectors = !design.conservative ? 4000 : 50000;
  auto operands = operand_vectors(input_ports(graph), static_cast<int>(vectors), random.bits());
  for (std::size_t i = 0; with_rays && i < vectors; ++i)
    operands.push_back(ray_and_box(random, format.as<hls::IntBits>()));
  std::size_t compared = 0;
  std::size_t hits = 0;
  for (const auto& v : operands) {
    const bool hit = native(v.data());
    const std::vector<std::uint64_t> in(v.begin(), v.end());
    const bool traced = evaluate(graph, in).front() != 0;
    if (hit != traced) {
      std::string text;
      for (std::size_t i = 0; i < v.size(); ++i) {
        text += graph[graph.inputs()[i]].name + " " + std::to_string(v[i]) + " ";
      }
      FAIL() << "native " << hit << ", traced " << traced << ": " << text;
    }
    ++compared;
    hits += hit ? 1 : 0;
  }
  EXPECT_EQ(compared, with_rays ? 2 * vectors : vectors);
  EXPECT_GT(hits, compared / 1000);
  EXPECT_LT(hits, compared - compared / 1000);
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
  int compared = 0;
  for (const auto& v : operand_vectors(input_ports(graph), 2000, 9)) {
    std::vector<std::int64_t> noisy = v;
    for (std::size_t i = 0; i < v.size(); ++i) {
      const int width = graph[graph.inputs()[i]].width;
      noisy[i] ^= static_cast<std::int64_t>(random.bits() << width);
    }
    ASSERT_EQ(native(noisy.data()), native(v.data()));
    ++compared;
  }
  EXPECT_EQ(compared, 2000);
}

/// For any bits, a format chosen at run time gives the answer of the instance that knows it when compiled.
template <class Pipeline, class F>
void expect_equal_answers(std::uint64_t seed) {
  const typename Pipeline::Bits bits = F::bits;
  constexpr int vectors = 20000;
  const auto operands = operand_vectors(input_ports(traced<Pipeline>(bits)), vectors, seed);
  int hits = 0;
  for (const auto& v : operands) {
    std::int64_t built_in = -1;
    std::int64_t any = -1;
    detail::run<Pipeline, hls::Native>(F(), v.data(), &built_in);
    detail::run_any<Pipeline>(bits, v.data(), &any);
    ASSERT_EQ(any, built_in) << Pipeline::name << ", seed " << seed;
    hits += any == 1 ? 1 : 0;
  }
  EXPECT_EQ(operands.size(), static_cast<std::size_t>(vectors));
  EXPECT_GT(hits, 0);
  EXPECT_LT(hits, vectors);
}

template <class Pipeline>
void expect_equal_integer_answers() {
  expect_equal_answers<Pipeline, hls::IntFormat<24, 24>>(301);
  expect_equal_answers<Pipeline, hls::IntFormat<20, 24>>(302);
  expect_equal_answers<Pipeline, hls::IntFormat<4, 4>>(303);
  expect_equal_answers<Pipeline, hls::IntFormat<6, 11>>(304);
  expect_equal_answers<Pipeline, hls::IntFormat<17, 19>>(305);
  expect_equal_answers<Pipeline, hls::IntFormat<31, 40>>(306);
  expect_equal_answers<Pipeline, hls::IntFormat<32, 6>>(307);
  expect_equal_answers<Pipeline, hls::IntFormat<32, 63>>(308);
}
template <class Pipeline>
void expect_equal_float_answers() {
  expect_equal_answers<Pipeline, hls::Fp32>(311);
  expect_equal_answers<Pipeline, hls::FpFormat<3, 2>>(312);
  expect_equal_answers<Pipeline, hls::FpFormat<5, 10>>(313);
  expect_equal_answers<Pipeline, hls::FpFormat<8, 1>>(314);
}

void expect_equal_major_answers() {
  expect_equal_answers<hls::IntMajor, hls::MajorFormat<20, 1, 13>>(321);
  expect_equal_answers<hls::IntMajor, hls::MajorFormat<16, 0, 8>>(322);
  expect_equal_answers<hls::IntMajor, hls::MajorFormat<4, 0, 3>>(323);
  expect_equal_answers<hls::IntMajor, hls::MajorFormat<12, 2, 10, 1>>(324);
  expect_equal_answers<hls::IntMajor, hls::MajorFormat<8, 3, 6, -1>>(325);
  expect_equal_answers<hls::IntMajor, hls::MajorFormat<32, 3, 28, 3>>(326);
  expect_equal_answers<hls::IntMajor, hls::MajorFormat<17, 0, 5, 3>>(327);
}

TEST(AnyFormat, AnswersAsTheBuiltInInstance) {
  expect_equal_integer_answers<hls::IntSlabs>();
  expect_equal_integer_answers<hls::IntPlucker>();
  expect_equal_major_answers();
  expect_equal_float_answers<hls::FpSlabs>();
  expect_equal_float_answers<hls::FpPlucker>();
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
  for (int n = hls::MajorBits::min_proved_coord; n <= hls::MajorBits::max_coord; ++n) {
    for (int g = 0; g <= hls::MajorBits::max_finer; ++g) {
      for (int f = hls::MajorBits::min_fraction; f <= hls::MajorBits::max_fraction; ++f) {
        const hls::MajorBits bits{n, g, 4 + formats % 25, f};
        ASSERT_TRUE(bits.proved());
        SCOPED_TRACE(to_string(Format(bits)));
        ASSERT_NO_FATAL_FAILURE(expect_graph_agrees<hls::IntMajor>(bits, vectors, hits));
        ++formats;
      }
    }
  }
  EXPECT_EQ(formats, 29 * 4 * 6);
  EXPECT_GT(hits, formats * vectors / 200);
  EXPECT_LT(hits, formats * vectors / 2);
}

TEST(AnyFormat, FloatsOfAnyWidthHaveTheGraphOfTheirAnswers) {
  for (const hls::FpBits bits : {hls::FpBits{3, 2}, hls::FpBits{2, 1}, hls::FpBits{5, 10}, hls::FpBits{8, 7},
                                 hls::FpBits{2, 23}, hls::FpBits{8, 1}}) {
    int hits = 0;
    SCOPED_TRACE(std::to_string(bits.exponent) + "," + std::to_string(bits.fraction));
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
