// What shares and what does not, and how near the least area the search comes: against all schedules and
// bindings of small graphs.
#include "rtl_gen/schedule/least_area.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "rtl_gen/component/product.hpp"
#include "rtl_gen/graph/canonical.hpp"
#include "tests/rtl_gen/catalogue/formats.hpp"
#include "tests/rtl_gen/component/unit_library.hpp"
#include "tests/rtl_gen/seeded.hpp"

namespace hitpipe::rtl::least_area_test {
namespace {

/// The components that carry out the operations of a kind.
int components(const Graph& g, const Binding& binding, Op op) {
  int count = 0;
  for (NodeId id = 0; id < g.size(); ++id) count += g[id].op == op && !binding.shares(id) ? 1 : 0;
  for (const auto& [instance, operations] : binding.instances())
    count += g[operations.front()].op == op ? 1 : 0;
  return count;
}

SharedSchedule shared(const Graph& g, const Library& library, int interval) {
  const int clock_ps = schedule_asap(g, library).clock_ps;
  return share_for_least_area(g, library, interval, sharing_prices(g, library, clock_ps));
}

/// Sums of products of 12 bits: `pairs` products, each of inputs of its own.
Graph products(int pairs) {
  Graph g("products");
  for (int i = 0; i < pairs; ++i) {
    const NodeId a = g.input("a" + std::to_string(i), 12, true);
    const NodeId b = g.input("b" + std::to_string(i), 12, true);
    g.output("o" + std::to_string(i), g.slice(g.binary(Op::mul, a, b, true), 3, 0));
  }
  return g;
}

TEST(LeastArea, AnAreaIsTheSumOfItsParts) {
  const Library library = unit_library();
  const Graph g = products(2);
  const SharingPrices prices = sharing_prices(g, library, 11);
  const SharedSchedule apart = schedule_modulo({.graph = g, .library = library, .interval = 2});
  // Two products of 144; 48 bits of operands and 8 of results; a valid bit at 4 boundaries, the tag at 2.
  EXPECT_EQ(area_of(g, apart, prices), 2 * 144 + 48 + 8 + 4 + 2 * 16);
  std::vector<SharingGroup> groups = kinds_of(g);
  groups.front().instances = 1;
  const SharedSchedule together =
      schedule_modulo({.graph = g, .library = library, .interval = 2, .groups = groups});
  // One product; 24 bits of latches and of multiplexers before it; 48 bits of operands and 8 of results, of
  // which a half is held for a stage more; a valid bit at 6 boundaries, the tag at 3.
  EXPECT_EQ(area_of(g, together, prices), 144 + 24 + 24 + 48 + 8 + 6 + 3 * 16);
}

TEST(LeastArea, AConstantThatAllReadIsNotSelected) {
  const Library library = unit_library();
  Graph g("scaled");
  const NodeId factor = g.constant(12, 5);
  for (const char* name : {"a", "b"})
    g.output(name, g.slice(g.binary(Op::mul, g.input(name, 12, true), factor, true), 3, 0));
  std::vector<SharingGroup> groups = kinds_of(g);
  groups.front().instances = 1;
  const SharedSchedule s = schedule_modulo({.graph = g, .library = library, .interval = 2, .groups = groups});
  // One product with 12 bits of latches and of multiplexers; 24 bits of operands and 8 of results, of which a
  // half is held for a stage more; a valid bit at 6 boundaries, the tag at 3.
  EXPECT_EQ(area_of(g, s, sharing_prices(g, library, 11)), 144 + 12 + 12 + 24 + 8 + 6 + 3 * 16);
}

TEST(LeastArea, AProductIsSharedAndAMultiplexerIsNot) {
  const Library library = unit_library();
  Graph g = products(4);
  const NodeId select = g.input("s", 1, false);
  for (NodeId i = 0; i < 3; ++i) g.output("m", g.mux(select, g.inputs()[i], g.inputs()[i + 1]));
  const SharedSchedule s = shared(g, library, 2);
  EXPECT_EQ(components(g, s.binding, Op::mul), 2);
  EXPECT_EQ(components(g, s.binding, Op::mux), 3);
}

TEST(LeastArea, AnIntervalOfOneSharesNothing) {
  const Library library = unit_library();
  const Graph g = products(3);
  const SharedSchedule s = shared(g, library, 1);
  EXPECT_TRUE(s.binding.instance_of.empty());
  EXPECT_EQ(s.schedule.stages, schedule_asap(g, library).stages);
}

TEST(LeastArea, AProductThatIsLeftOverKeepsItsOwn) {
  const Library library = unit_library();
  const Graph g = products(3);
  const SharedSchedule s = shared(g, library, 2);
  EXPECT_EQ(components(g, s.binding, Op::mul), 2);
  EXPECT_EQ(s.binding.instance_of.size(), 2) << "a component for one operation needs no selection";
}

/// With a clock of 11 ps a multiplexer can select among 32 operands.
TEST(LeastArea, AnInstanceHasNoMoreOperationsThanTheClockCanSelect) {
  const Library library = unit_library();
  const Graph g = products(40);
  const SharedSchedule s = shared(g, library, 64);
  ASSERT_FALSE(s.binding.instance_of.empty());
  for (const auto& [instance, operations] : s.binding.instances()) EXPECT_LE(operations.size(), 32U);
}

TEST(LeastArea, IntSlabsTakesSixThreeTwoAndOneProduct) {
  const Library library = library_called("xc7");
  const Graph traced = find_design("int_slabs").trace(hls::IntBits{16, 16});
  for (const auto& [interval, blocks] : {std::pair{1, 6}, {2, 3}, {3, 2}, {6, 1}}) {
    const Pipeline p = make_pipeline(traced, library, std::nullopt, interval);
    EXPECT_EQ(p.interval(), interval);
    EXPECT_EQ(components(p.graph, p.binding, Op::mul), blocks) << interval;
  }
}

class LeastAreaOfDesign : public testing::TestWithParam<DesignFormat> {};

TEST_P(LeastAreaOfDesign, SharesAndIsSmaller) {
  const Library& library = Library::thesis();
  const Pipeline p = GetParam().pipeline();
  const SharingPrices prices = sharing_prices(p.graph, library, p.schedule.clock_ps);
  const std::int64_t apart = area_of(p.graph, {p.schedule, {}}, prices);
  const SharedSchedule s = share_for_least_area(p.graph, library, 3, prices);
  EXPECT_LT(area_of(p.graph, s, prices), apart);
  EXPECT_GE(s.binding.instance_of.size(), 2);
  EXPECT_EQ(verify(p.graph, library, s.schedule, s.binding), std::vector<std::string>{});
}

INSTANTIATE_TEST_SUITE_P(Designs, LeastAreaOfDesign, testing::ValuesIn(every_design({"16/16"})),
                         design_suffix);

/// Tries every stage and every instance for each operation, with at most so many stages, and keeps the least
/// area of the legal schedules.
class Exhaustive {
 public:
  Exhaustive(const Graph& g, const Library& library, int interval, const SharingPrices& prices, int stages)
      : g_(g), library_(library), prices_(prices), stages_(stages) {
    made_.schedule = schedule_asap(g, library);
    made_.binding.interval = interval;
    for (NodeId id = 0; id < g.size(); ++id)
      if (is_component(g[id].op)) operations_.push_back(id);
    try_from(0);
  }
  [[nodiscard]] std::int64_t least() const { return least_; }
  [[nodiscard]] int legal() const { return legal_; }

 private:
  void try_from(std::size_t place) {
    if (place == operations_.size()) {
      made_.schedule.stages = 1;
      for (const NodeId id : operations_)
        made_.schedule.stages = std::max(made_.schedule.stages, made_.schedule.slots[id].finish);
      if (!verify(g_, library_, made_.schedule, made_.binding).empty()) return;
      ++legal_;
      least_ = std::min(least_, area_of(g_, made_, prices_));
      return;
    }
    const NodeId id = operations_[place];
    const Slot before = made_.schedule.slots[id];
    const Cell cell = timing_of(g_, id, library_);
    for (int instance = -1; instance < 2; ++instance) {
      if (instance >= 0) made_.binding.instance_of[id] = instance;
      for (int stage = 1; stage <= stages_; ++stage) {
        const int finish = stage + (instance >= 0 ? 1 : 0) + std::max(cell.stages, 1) - 1;
        const int ready_ps = cell.stages > 0 ? 0 : cell.delay_ps;
        made_.schedule.slots[id] = {stage, finish, ready_ps, cell.stages > 0};
        try_from(place + 1);
      }
      made_.binding.instance_of.erase(id);
    }
    made_.schedule.slots[id] = before;
  }

  const Graph& g_;
  const Library& library_;
  const SharingPrices& prices_;
  int stages_;
  SharedSchedule made_;
  std::vector<NodeId> operations_;
  std::int64_t least_ = std::numeric_limits<std::int64_t>::max();
  int legal_ = 0;
};

/// Three or four products and differences of the same inputs and of one another.
Graph small_graph(Seeded& random) {
  Graph g("small");
  const int width = random.flip() ? 8 : 12;
  std::vector<NodeId> values;
  for (int i = 0; i < 3; ++i) values.push_back(g.input("a" + std::to_string(i), width, true));
  const auto any = [&] {
    return values[static_cast<std::size_t>(random.below(static_cast<int>(values.size())))];
  };
  for (int i = 0; i < 4; ++i) {
    const NodeId a = any();
    const NodeId b = any();
    values.push_back(i % 2 == 0 ? g.slice(g.binary(Op::mul, a, b, true), width - 1, 0)
                                : g.binary(Op::sub, a, b));
  }
  for (std::size_t i = 3; i < values.size(); ++i) g.output("o" + std::to_string(i), values[i]);
  return canonical(g);
}

TEST(LeastArea, IsNearTheLeastOfAllSchedulesAndBindings) {
  const Library library = unit_library();
  int least = 0;
  int graphs = 0;
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    Seeded random(seed);
    const Graph g = small_graph(random);
    const SharingPrices prices = sharing_prices(g, library, schedule_asap(g, library).clock_ps);
    const SharedSchedule found = shared(g, library, 2);
    const Exhaustive all(g, library, 2, prices, found.schedule.stages);
    ASSERT_GT(all.legal(), 0) << seed;
    const std::int64_t area = area_of(g, found, prices);
    EXPECT_GE(area, all.least()) << seed;
    EXPECT_LE(area * 100, all.least() * 104) << seed;
    least += area == all.least() ? 1 : 0;
    ++graphs;
  }
  EXPECT_GE(least, 7) << "of " << graphs << " graphs";
}

}  // namespace
}  // namespace hitpipe::rtl::least_area_test
