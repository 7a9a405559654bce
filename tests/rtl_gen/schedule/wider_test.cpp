// Operations on wider components: the graph computes the same, the schedule is legal, and the unit is
// smaller.
#include "rtl_gen/schedule/wider.hpp"

#include <gtest/gtest.h>

#include "rtl_gen/graph/canonical.hpp"
#include "rtl_gen/graph/graph_lanes.hpp"
#include "tests/rtl_gen/catalogue/formats.hpp"
#include "tests/rtl_gen/component/unit_library.hpp"
#include "tests/rtl_gen/graph/recipe.hpp"

namespace hitpipe::rtl::wider_test {
namespace {

using Shapes = std::map<NodeId, ComponentShape>;

/// Each operation on the smallest component that carries out all that it can carry out together with those
/// before it.
Shapes all_together(const Graph& g) {
  std::vector<ComponentShape> largest;
  std::map<NodeId, std::size_t> of;
  for (NodeId id = 0; id < g.size(); ++id) {
    const auto own = shape_of_operation(g, id);
    if (!own) continue;
    std::size_t at = 0;
    while (at < largest.size() && !shape_of_both(largest[at], *own)) ++at;
    if (at == largest.size()) largest.push_back(*own);
    largest[at] = *shape_of_both(largest[at], *own);
    of[id] = at;
  }
  Shapes shapes;
  for (const auto& [id, at] : of) shapes[id] = largest[at];
  return shapes;
}

std::set<NodeId> products(const Graph& g) {
  std::set<NodeId> ids;
  for (NodeId id = 0; id < g.size(); ++id)
    if (g[id].op == Op::mul) ids.insert(id);
  return ids;
}

/// Compares the outputs of two graphs for random inputs, node by node and in lanes.
void expect_same(const Graph& one, const Graph& other, Seeded& random) {
  std::vector<std::vector<std::int64_t>> vectors;
  for (std::size_t i = 0; i < most_lanes; ++i) {
    std::vector<std::uint64_t> inputs;
    for (const NodeId id : one.inputs()) inputs.push_back(random.value(one[id].width));
    ASSERT_EQ(evaluate(one, inputs), evaluate(other, inputs)) << to_text(one) << to_text(other);
    vectors.emplace_back(inputs.begin(), inputs.end());
  }
  GraphLanes of_one(one), of_other(other);
  of_one.load(vectors);
  of_other.load(vectors);
  for (std::size_t i = 0; i < one.outputs().size(); ++i)
    EXPECT_EQ(of_one.right(one.outputs()[i].node), of_other.right(other.outputs()[i].node));
}

int components(const SharedGraph& made, Op op) {
  int count = 0;
  for (NodeId id = 0; id < made.graph.size(); ++id)
    count += made.graph[id].op == op && !made.shared.binding.shares(id) ? 1 : 0;
  for (const auto& [instance, operations] : made.shared.binding.instances())
    count += made.graph[operations.front()].op == op ? 1 : 0;
  return count;
}

TEST(Wider, TheComponentOfBothHasTheLargerWidths) {
  const ComponentShape mul{Op::mul, true, 41, 20};
  EXPECT_EQ(shape_of_both(mul, {Op::mul, true, 22, 22}), (ComponentShape{Op::mul, true, 41, 22}));
  EXPECT_EQ(shape_of_both(mul, {Op::mul, false, 22, 22}), std::nullopt) << "of unsigned numbers";
  EXPECT_EQ(shape_of_both({Op::mul, true, 100, 10}, {Op::mul, true, 60, 60}), std::nullopt) << "160 bits";
  EXPECT_EQ(shape_of_both({Op::sub, false, 8, 8}, {Op::sub, false, 9, 9}),
            (ComponentShape{Op::sub, false, 9, 9}));
  EXPECT_EQ(shape_of_both({Op::sub, false, 8, 8}, {Op::add, false, 7, 7}),
            (ComponentShape{Op::add, false, 8, 8}));
  EXPECT_EQ(shape_of_both({Op::less, true, 8, 8}, {Op::equal, false, 8, 8}), std::nullopt);
}

/// Every kind of operation in two widths, and products with the wider operand on either side.
TEST(Wider, EachOperationComputesTheSame) {
  Graph g("each");
  const NodeId a = g.input("a", 12, true);
  const NodeId b = g.input("b", 9, true);
  const NodeId short_a = g.slice(a, 8, 0);
  int outputs = 0;
  const auto both = [&](Op op, bool is_signed) {
    g.output("o" + std::to_string(outputs++), g.binary(op, a, g.extend(b, 12, true), is_signed));
    g.output("o" + std::to_string(outputs++), g.binary(op, short_a, b, is_signed));
  };
  for (const Op op : {Op::add, Op::sub, Op::equal}) both(op, false);
  for (const Op op : {Op::less, Op::mul}) both(op, false), both(op, true);
  g.output("p", g.binary(Op::mul, b, a, true));
  const Graph wide = widened(g, all_together(g));
  EXPECT_EQ(kinds_of(wide).size(), 6) << "sums and differences, equal, and two of less and mul";
  for (NodeId id = 0; id < wide.size(); ++id) EXPECT_NE(wide[id].op, Op::sub);
  Seeded random(1);
  for (int i = 0; i < 20; ++i) expect_same(g, wide, random);
}

TEST(Wider, RandomGraphsComputeTheSame) {
  int changed = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Seeded random(seed);
    const Graph g = canonical(Recipe(random, 5, 60, 3).graph());
    const Graph wide = widened(g, all_together(g));
    changed += to_text(g) != to_text(wide) ? 1 : 0;
    expect_same(g, wide, random);
    expect_same(g, with_products_cut(g, products(g)), random);
  }
  EXPECT_GT(changed, 70) << "of 100";
}

TEST(Wider, AProductIsCutIntoTwoOfHalfTheWidth) {
  Graph g("cut");
  const NodeId p = g.binary(Op::mul, g.input("a", 20, true), g.input("b", 41, true), true);
  g.output("o", g.slice(p, 60, 0));
  const Graph cut = with_products_cut(g, {p});
  std::vector<ComponentShape> shapes;
  for (NodeId id = 0; id < cut.size(); ++id)
    if (const auto shape = shape_of_operation(cut, id)) shapes.push_back(*shape);
  const ComponentShape half{Op::mul, true, 21, 20};
  EXPECT_EQ(shapes, (std::vector{half, half, ComponentShape{Op::add, false, 41, 41}}));
}

/// Products and sums of two widths and both signs, whose operands are there at once or after one another.
Graph mixed(Seeded& random) {
  Graph g("mixed");
  std::vector<NodeId> values;
  for (int i = 0; i < 4; ++i) values.push_back(g.input("a" + std::to_string(i), 6 + i, true));
  for (int i = 0; i < 8; ++i) {
    const auto any = [&] {
      return values[static_cast<std::size_t>(random.below(static_cast<int>(values.size())))];
    };
    const NodeId a = any();
    const NodeId b = any();
    const int width = 7 + random.below(3);
    values.push_back(g.resize(g.binary(Op::mul, a, b, i % 3 != 0), 10, i % 2 == 0));
    values.push_back(
        g.binary(random.flip() ? Op::add : Op::sub, g.resize(a, width, true), g.resize(b, width, true)));
  }
  for (std::size_t i = 4; i < values.size(); ++i) g.output("o" + std::to_string(i), values[i]);
  return canonical(g);
}

TEST(Wider, MixedWidthsShareInASmallerUnitThatComputesTheSame) {
  const Library library = unit_library();
  int smaller = 0;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    Seeded random(seed);
    const Graph g = mixed(random);
    const int clock_ps = schedule_asap(g, library).clock_ps;
    for (int interval = 2; interval <= 5; ++interval) {
      const SharedGraph made = share_widened(g, library, interval);
      EXPECT_EQ(verify(made.graph, library, made.shared.schedule, made.shared.binding),
                std::vector<std::string>{});
      EXPECT_EQ(made.shared.schedule.clock_ps, clock_ps);
      expect_same(g, made.graph, random);
      const SharingPrices prices = sharing_prices(g, library, clock_ps);
      const std::int64_t of_one_width =
          area_of(g, share_for_least_area(g, library, interval, prices), prices);
      const std::int64_t area =
          area_of(made.graph, made.shared, sharing_prices(made.graph, library, clock_ps));
      EXPECT_LE(area, of_one_width);
      smaller += area < of_one_width ? 1 : 0;
    }
  }
  EXPECT_GE(smaller, 20) << "of 24";
}

/// Its 21 products have five widths: 10 of some 20 by 20 bits and 11 of some 40 by 20.
TEST(Wider, TheTriangleTestHasNoMoreMultipliersThanItsProductsFill) {
  const Library& library = Library::thesis();
  const Design& design = find_design("int_triangle");
  const Graph g = canonical(design.trace(design.default_format));
  for (const auto& [interval, multipliers] : {std::pair{4, 6}, {8, 3}}) {
    const SharedGraph made = share_widened(g, library, interval);
    EXPECT_EQ(components(made, Op::mul), multipliers) << interval;
    EXPECT_EQ(made.shared.schedule.clock_ps, schedule_asap(g, library).clock_ps);
    Seeded random(7);
    expect_same(g, made.graph, random);
  }
}

/// Products of 4 by 4 and of 6 by 2 bits take 5 ps, one of 6 by 4 bits 10 ps in each of two stages.
TEST(Wider, TheClockStaysAsItIs) {
  const Library library = Library::from_json(
      replaced(std::string(unit_json), R"({"bits": 4, "area_um2": 16, "delay_ps": 10, "stages": 0})",
               R"({"bits": 4, "area_um2": 16, "delay_ps": 5, "stages": 0})"),
      "unit.json");
  Graph g("clock");
  for (int i = 0; i < 4; ++i) {
    const NodeId a = g.input("a" + std::to_string(i), i < 2 ? 4 : 6, true);
    const NodeId b = g.input("b" + std::to_string(i), i < 2 ? 4 : 2, true);
    g.output("o" + std::to_string(i), g.binary(Op::mul, a, b, true));
  }
  const int clock_ps = schedule_asap(g, library).clock_ps;
  EXPECT_EQ(clock_ps, 6);
  const SharedGraph made = share_widened(g, library, 4);
  EXPECT_EQ(made.shared.schedule.clock_ps, clock_ps);
  EXPECT_EQ(share_widened(g, library, 4, 20).shared.schedule.clock_ps, 20);
}

}  // namespace
}  // namespace hitpipe::rtl::wider_test
