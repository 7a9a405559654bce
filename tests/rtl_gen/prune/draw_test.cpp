// Drawn operands are as demanded, wherever they are drawn; half of the vectors are beside hits.
#include "rtl_gen/prune/draw.hpp"

#include <set>

#include <gtest/gtest.h>

#include "tests/message_of.hpp"
#include "tests/rtl_gen/catalogue/formats.hpp"
#include "tests/rtl_gen/prune/random_demands.hpp"

namespace hitpipe::rtl::draw_test {
namespace {

/// Random ports with random demands. xmin and xmax are of one kind.
struct Drawn {
  explicit Drawn(Seeded& random) {
    for (const char* const name : {"a", "b", "xmin", "xmax", "c"})
      ports.push_back({name, random.between(2, 40), random.flip()});
    ports[3].width = ports[2].width;
    ports[3].is_signed = ports[2].is_signed;
    demands = random_demands(random, ports);
  }
  std::vector<Port> ports;
  Demands demands;
};
constexpr int sets = 60;
constexpr int draws = 300;

TEST(Draw, IsAsDemandedAndReachesTheEnds) {
  Seeded random(31);
  for (int set = 0; set < sets; ++set) {
    const Drawn drawn(random);
    const Draw draw(drawn.ports, drawn.demands);
    bool low = drawn.demands.ports.empty();
    for (int i = 0; i < draws; ++i) {
      const std::vector<std::int64_t> operands = draw(random);
      ASSERT_TRUE(meets(drawn.demands, drawn.ports, operands.data()));
      for (std::size_t p = 0; p < drawn.ports.size(); ++p) {
        const Interval all = all_numbers(drawn.ports[p]);
        ASSERT_TRUE(operands[p] >= all.low && operands[p] <= all.high) << drawn.ports[p].name;
        for (const PortDemand& each : drawn.demands.ports)
          low |= each.port == drawn.ports[p].name && operands[p] == hull(each).low;
      }
    }
    EXPECT_TRUE(low) << "set " << set;
  }
}

TEST(Draw, BesideIsAsDemandedAndChangesTwoPortsAtMost) {
  Seeded random(37);
  int changed = 0;
  for (int set = 0; set < sets; ++set) {
    Drawn drawn(random);
    drawn.demands.orders.clear();  // putting in order changes another port
    const Draw draw(drawn.ports, drawn.demands);
    std::vector<std::int64_t> operands = draw(random);
    for (int i = 0; i < draws; ++i) {
      const std::vector<std::int64_t> near = draw.beside(operands, random);
      ASSERT_TRUE(meets(drawn.demands, drawn.ports, near.data()));
      int ports_changed = 0;
      for (std::size_t p = 0; p < near.size(); ++p) ports_changed += near[p] != operands[p] ? 1 : 0;
      ASSERT_LE(ports_changed, 2);
      changed += ports_changed > 0 ? 1 : 0;
      operands = near;
    }
  }
  EXPECT_GT(changed, sets * draws / 2);
}

TEST(Draw, TakesPortsOf64Bits) {
  Seeded random(41);
  const std::vector<Port> ports{{"wide", 64, true}};
  const Draw draw(ports, {{{"wide", {{INT64_MIN, INT64_MAX}}, 8}}, {}});
  std::set<bool> signs;
  for (int i = 0; i < 100; ++i) {
    const std::int64_t number = draw.beside(draw(random), random).front();
    EXPECT_EQ(number & 0xff, 0);
    signs.insert(number < 0);
  }
  EXPECT_EQ(signs.size(), 2U);
}

TEST(Draw, EndsWithAnErrorWhereNothingMeetsTheDemands) {
  Seeded random(43);
  const std::vector<Port> ports{{"a", 8, false}, {"b", 8, false}};
  // Both orders make b equal to a, which is 10; b may be anything else.
  const Demands demands{{{"a", {{10, 10}}}, {"b", {{0, 9}, {11, 20}}}}, {{"a", "b"}, {"b", "a"}}};
  const Draw draw(ports, demands);
  EXPECT_EQ(message_of([&] { return draw(random); }), "demands: none of 100000 draws meets all of them");
}

class DrawnVectors : public testing::TestWithParam<DesignFormat> {};

TEST_P(DrawnVectors, AreAsDemandedAndHitAboutEveryOtherTime) {
  constexpr int count = 4000;
  const Design& design = GetParam().found();
  const Format format = GetParam().parsed();
  const std::vector<Port> ports = design.ports(format);
  const Evaluate evaluate = design.evaluate(format);
  for (const DemandSet& set : demand_sets(design, format)) {
    DrawVectors draw(ports, set.demands, design.evaluate(format), 1);
    DrawVectors again(ports, set.demands, design.evaluate(format), 1);
    int hits = 0;
    for (int i = 0; i < count; ++i) {
      const Vector vector = draw();
      ASSERT_TRUE(meets(set.demands, ports, vector.operands.data())) << set.name;
      ASSERT_EQ(vector.results, with_results(vector.operands, evaluate).results);
      ASSERT_EQ(vector.operands, again().operands);
      hits += evaluate.yes(vector.results.data()) ? 1 : 0;
    }
    EXPECT_GT(hits, count / 4) << set.name;
    EXPECT_LT(hits, count * 3 / 4) << set.name;
  }
}

INSTANTIATE_TEST_SUITE_P(Designs, DrawnVectors, testing::ValuesIn(every_design({"20/24"})), design_suffix);

}  // namespace
}  // namespace hitpipe::rtl::draw_test
