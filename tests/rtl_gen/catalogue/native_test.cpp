// One C++ source, two meanings that must agree: the pipeline run on the host, and the graph it records.
#include "rtl_gen/catalogue/native.hpp"

#include <gtest/gtest.h>

#include "rtl_gen/emit/testbench.hpp"
#include "rtl_gen/graph/canonical.hpp"
#include "tests/rtl_gen/catalogue/formats.hpp"
#include "tests/rtl_gen/seeded.hpp"

namespace hitpipe::rtl {
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
  // Corners and any bits, and for integer slabs as many rays and boxes, of which many hit.
  const bool with_rays = design.name == "int_slabs";
  // Float units are graphs inside the graph: slow to walk.
  const std::size_t vectors = design.is_float() ? 4000 : 50000;
  auto operands = operand_vectors(input_ports(graph), static_cast<int>(vectors), random.bits());
  for (std::size_t i = 0; with_rays && i < vectors; ++i)
    operands.push_back(ray_and_box(random, format.bits()));
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
                                                         "12/6", "6/6", "6/11", "32/6", "32/32", "32/63"})),
                         design_suffix);

TEST(Native, BitsAboveAPortsWidthAreIgnored) {
  const Evaluate native = find_design("int_slabs").evaluate({6, 6});
  const Graph graph = find_design("int_slabs").trace({6, 6});
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

}  // namespace
}  // namespace hitpipe::rtl
