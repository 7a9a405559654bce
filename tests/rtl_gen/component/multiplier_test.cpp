// The divided multiplier: every product of small widths, random products of large widths, and its stated
// stages.
#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "rtl_gen/component/product.hpp"
#include "rtl_gen/schedule/registers.hpp"
#include "tests/rtl_gen/seeded.hpp"

namespace hitpipe::rtl::multiplier_test {
namespace {

constexpr std::uint64_t mask(int width) {
  return ~std::uint64_t{0} >> (64 - width);
}

/// Bits high..low of the product, in two's complement if signed. Products have up to 64 bits.
std::uint64_t product(const MultiplierShape& shape, std::uint64_t a, std::uint64_t b) {
  if (shape.is_signed) {
    if ((a >> (shape.width_a - 1)) != 0) a |= ~mask(shape.width_a);
    if ((b >> (shape.width_b - 1)) != 0) b |= ~mask(shape.width_b);
  }
  return (a * b) >> shape.low & mask(shape.high - shape.low + 1);
}

std::string described(const MultiplierShape& s) {
  return std::to_string(s.width_a) + "x" + std::to_string(s.width_b) + (s.is_signed ? "s" : "u") + " in " +
         std::to_string(s.stages) + " stages, bits " + std::to_string(s.high) + ":" + std::to_string(s.low);
}

struct Kept {
  int high;
  int low;
};
/// All bits; without the repeated sign; the upper half; the lower; one at each end; some within.
std::vector<Kept> kept_ranges(int width) {
  return {{width - 1, 0},         {width - 2, 0}, {width - 2, width / 2}, {width / 2, 0},
          {width - 1, width - 1}, {0, 0},         {width - 3, 2}};
}

std::vector<MultiplierShape> shapes(int width_a, int width_b, int most_stages) {
  std::vector<MultiplierShape> list;
  for (const bool is_signed : {true, false}) {
    for (int stages = 1; stages <= most_stages; ++stages) {
      for (const Kept& kept : kept_ranges(width_a + width_b)) {
        list.push_back({width_a, width_b, is_signed, stages, kept.high, kept.low});
      }
    }
  }
  return list;
}

TEST(Multiplier, EveryProductOfSmallWidths) {
  int compared = 0;
  int intended = 0;
  const struct {
    int width_a, width_b, most_stages;
  } sizes[] = {{5, 5, 4}, {6, 4, 4}, {4, 6, 4}, {5, 2, 2}, {3, 3, 3}, {4, 1, 1}};
  for (const auto& [width_a, width_b, most_stages] : sizes) {
    intended += 2 * most_stages * static_cast<int>(kept_ranges(width_a + width_b).size())
                << (width_a + width_b);
    for (const MultiplierShape& shape : shapes(width_a, width_b, most_stages)) {
      const Graph graph = multiplier(shape, "mul");
      for (std::uint64_t a = 0; a <= mask(width_a); ++a) {
        for (std::uint64_t b = 0; b <= mask(width_b); ++b, ++compared) {
          const std::vector<std::uint64_t> p = evaluate(graph, std::vector<std::uint64_t>{a, b});
          ASSERT_EQ(p.at(0), product(shape, a, b)) << described(shape) << ", a " << a << ", b " << b;
        }
      }
    }
  }
  EXPECT_EQ(compared, intended);
}

TEST(Multiplier, RandomProductsOfLargeWidths) {
  constexpr int vectors = 2000;
  Seeded random(127);
  int compared = 0;
  int intended = 0;
  const struct {
    int width_a, width_b, most_stages;
  } sizes[] = {{24, 24, 4}, {32, 32, 4}, {32, 24, 8}, {20, 27, 5}};
  for (const auto& [width_a, width_b, most_stages] : sizes) {
    for (const MultiplierShape& shape : shapes(width_a, width_b, most_stages)) {
      const Graph graph = multiplier(shape, "mul");
      intended += vectors;
      for (int v = 0; v < vectors; ++v, ++compared) {
        const std::uint64_t a = random.value(width_a);
        const std::uint64_t b = random.value(width_b);
        const std::vector<std::uint64_t> p = evaluate(graph, std::vector<std::uint64_t>{a, b});
        ASSERT_EQ(p.at(0), product(shape, a, b))
            << described(shape) << std::hex << ", a " << a << ", b " << b;
      }
    }
  }
  EXPECT_EQ(compared, intended);
}

TEST(Multiplier, PartitionAsText) {
  EXPECT_EQ(to_text(multiplier({6, 4, true, 2, 8, 3}, "mul")),
            "graph mul\n"
            "%0 = input:6 signed  a\n"
            "%1 = input:4 signed  b\n"
            "%2 = slice:2 %1 [1:0]\n"
            "%3 = extend:3 %2\n"
            "%4 = mul:9 signed %0 %3 stage>=1  piece_0\n"
            "%5 = slice:7 %4 [8:2]\n"
            "%6 = slice:2 %1 [3:2]\n"
            "%7 = mul:8 signed %0 %6 stage>=1  piece_1\n"
            "%8 = slice:7 %7 [6:0]\n"
            "%9 = add:7 %5 %8 stage>=2  sum_1\n"
            "%10 = slice:6 %9 [6:1]\n"
            "output p %10\n");
}

// Stage 1 has the multiplications, each later stage one addition. So there is one stage for each piece.
TEST(Multiplier, StagesAreAsStated) {
  for (const MultiplierShape& shape :
       {MultiplierShape{24, 24, true, 3, 46, 23}, MultiplierShape{20, 20, true, 2, 38, 15},
        MultiplierShape{32, 32, false, 4, 63, 0}}) {
    SCOPED_TRACE(described(shape));
    const Graph graph = multiplier(shape, "mul");
    const Schedule schedule = schedule_as_stated(graph, shape.stages);
    std::vector<int> multiplications(static_cast<std::size_t>(shape.stages) + 1, 0);
    std::vector<int> additions = multiplications;
    for (NodeId id = 0; id < graph.size(); ++id) {
      const Node& n = graph[id];
      if (!is_root(n.op) || n.op == Op::input) continue;
      ASSERT_EQ(schedule.slots[id].stage, n.min_stage) << n.name;
      ASSERT_EQ(schedule.slots[id].finish, n.min_stage) << n.name;
      const auto stage = static_cast<std::size_t>(n.min_stage);
      multiplications[stage] += n.op == Op::mul ? 1 : 0;
      additions[stage] += n.op == Op::add ? 1 : 0;
      if (n.op == Op::mul) {
        const int piece = shape.width_b / shape.stages;
        EXPECT_EQ(graph[n.args[0]].width, shape.width_a);
        EXPECT_LE(graph[n.args[1]].width, piece + (shape.is_signed ? 1 : 0));
      }
    }
    for (int stage = 1; stage <= shape.stages; ++stage) {
      EXPECT_EQ(multiplications[static_cast<std::size_t>(stage)], stage == 1 ? shape.stages : 0);
      EXPECT_EQ(additions[static_cast<std::size_t>(stage)], stage == 1 ? 0 : 1);
    }
    for (const Register& r : place_registers(graph, schedule, Ports::direct).registers) {
      EXPECT_GE(r.boundary, 1);
      EXPECT_LT(r.boundary, shape.stages) << "the product itself is latched by its user";
      EXPECT_NE(graph[r.value].op, Op::input) << "operands are read in stage 1 only";
    }
  }
}

TEST(Multiplier, OneStageIsOneMultiplication) {
  const Graph graph = multiplier({6, 4, true, 1, 9, 0}, "mul");
  const Schedule schedule = schedule_as_stated(graph, 1);
  EXPECT_TRUE(place_registers(graph, schedule, Ports::direct).registers.empty());
  EXPECT_EQ(to_text(graph),
            "graph mul\n"
            "%0 = input:6 signed  a\n"
            "%1 = input:4 signed  b\n"
            "%2 = mul:10 signed %0 %1 stage>=1  piece_0\n"
            "output p %2\n");
}

}  // namespace
}  // namespace hitpipe::rtl::multiplier_test
