// Demands: which are legal, which say more than others, which operands meet them, and how they read.
#include "rtl_gen/prune/demands.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "rtl_gen/catalogue/design.hpp"
#include "tests/message_of.hpp"

namespace hitpipe::rtl::demands_test {
namespace {

const std::vector<Port> four_ports{{"a", 8, true}, {"b", 8, true}, {"c", 8, false}, {"d", 1, false}};

TEST(Demands, LegalOnesAreTaken) {
  check_demands({{{"a", {{-128, -5}, {3, 127}}}, {"c", {{0, 255}}}, {"d", {{1, 1}}}}, {{"a", "b"}}},
                four_ports);
  check_demands({{{"a", {{-128, 127}}, 7}, {"b", {{4, 4}}, 2}, {"c", {{250, 255}}, 2}}}, four_ports);
}

TEST(Demands, IllegalOnesAreRejected) {
  const struct {
    Demands demands;
    const char* complaint;
  } cases[] = {{{{{"e", {{0, 1}}}}}, "demand on e: no such port; there are: a, b, c, d"},
               {{{{"a", {{0, 1}}}, {"a", {{0, 1}}}}}, "demand on a: it is there twice"},
               {{{{"a", {}}}}, "demand on a: it allows no number"},
               {{{{"a", {{2, 1}}}}}, "demand on a: [2, 1] does not ascend"},
               {{{{"a", {{0, 3}, {3, 4}}}}}, "demand on a: [3, 4] does not ascend"},
               {{{{"a", {{0, 128}}}}}, "demand on a: [0, 128] is outside its 8 bits, [-128, 127]"},
               {{{{"c", {{-1, 0}}}}}, "demand on c: [-1, 0] is outside its 8 bits, [0, 255]"},
               {{{{"a", {{-128, 127}}, 8}}}, "demand on a: 8 low zeros, allowed are 0 to 7"},
               {{{{"d", {{0, 1}}, 1}}}, "demand on d: 1 low zeros, allowed are 0 to 0"},
               {{{{"a", {{0, 1}}, -1}}}, "demand on a: -1 low zeros, allowed are 0 to 7"},
               {{{{"a", {{-8, 0}, {1, 3}}, 2}}}, "demand on a: [1, 3] holds no multiple of 4"},
               {{{{"a", {{6, 6}}, 2}}}, "demand on a: 6 holds no multiple of 4"},
               {{{}, {{"a", "c"}}}, "demand a <= c: ports of different kinds"},
               {{{{"a", {{5, 9}}}, {"b", {{0, 4}}}}, {{"a", "b"}}}, "demand a <= b: no number of one is"},
               {{{{"a", {{5, 9}}, 2}, {"b", {{0, 7}}}}, {{"a", "b"}}}, "demand a <= b: no number of one is"}};
  for (const auto& each : cases)
    EXPECT_EQ(message_of<std::invalid_argument>([&] { check_demands(each.demands, four_ports); }),
              each.complaint);
}

TEST(Demands, MultiplesInAnInterval) {
  constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max();
  EXPECT_EQ(multiples_in({-5, 9}, 0), (Interval{-5, 9}));
  EXPECT_EQ(multiples_in({-5, 9}, 2), (Interval{-4, 8}));
  EXPECT_EQ(multiples_in({-8, -8}, 3), (Interval{-8, -8}));
  EXPECT_EQ(multiples_in({-3, -1}, 2), std::nullopt);
  EXPECT_EQ(multiples_in({-most - 1, most}, 63), (Interval{-most - 1, 0}));
  EXPECT_EQ(multiples_in({most - 6, most}, 3), std::nullopt);
}

TEST(Demands, WeakerOnesAreImplied) {
  const Demands strong{{{"a", {{0, 4}, {7, 9}}}, {"b", {{10, 12}}}}, {}};
  EXPECT_TRUE(implies(strong, {{{"a", {{0, 9}}}}, {}}, four_ports));
  EXPECT_TRUE(implies(strong, {{}, {{"a", "b"}}}, four_ports));
  EXPECT_TRUE(implies(strong, {}, four_ports));
  EXPECT_TRUE(implies({}, {{{"c", {{0, 255}}}}, {}}, four_ports)) << "all that the port can have";
  EXPECT_FALSE(implies(strong, {{{"a", {{0, 8}}}}, {}}, four_ports));
  EXPECT_FALSE(implies(strong, {{{"a", {{0, 5}, {6, 8}}}}, {}}, four_ports));
  EXPECT_FALSE(implies(strong, {{{"c", {{1, 255}}}}, {}}, four_ports));
  EXPECT_FALSE(implies(strong, {{}, {{"b", "a"}}}, four_ports));
}

TEST(Demands, MoreLowZerosImplyFewer) {
  const std::vector<Interval> whole{{-128, 127}};
  const Demands multiples_of_4{{{"a", {{-10, 10}}, 2}}, {}};
  EXPECT_TRUE(implies(multiples_of_4, {{{"a", whole, 1}}, {}}, four_ports));
  EXPECT_TRUE(implies(multiples_of_4, {{{"a", {{-8, 8}}}}, {}}, four_ports)) << "none beyond";
  EXPECT_TRUE(implies({{{"a", {{12, 12}}}}, {}}, {{{"a", whole, 2}}, {}}, four_ports)) << "a constant";
  EXPECT_FALSE(implies(multiples_of_4, {{{"a", whole, 3}}, {}}, four_ports));
  EXPECT_FALSE(implies({{{"a", {{4, 8}}}}, {}}, {{{"a", whole, 2}}, {}}, four_ports));
  EXPECT_FALSE(implies({}, {{{"c", {{0, 255}}, 1}}, {}}, four_ports));
}

TEST(Demands, OperandsMeetThemOrNot) {
  const Demands demands{{{"a", {{-3, -1}, {1, 3}}}}, {{"a", "b"}}};
  const auto met = [&](std::int64_t a, std::int64_t b) {
    const std::int64_t operands[] = {a, b, 0, 0};
    return meets(demands, four_ports, operands);
  };
  EXPECT_TRUE(met(-3, -3));
  EXPECT_TRUE(met(3, 5));
  EXPECT_FALSE(met(0, 5));
  EXPECT_FALSE(met(4, 5));
  EXPECT_FALSE(met(3, 2));
  EXPECT_TRUE(meets(PortDemand{"a", {{-9, 9}}, 2}, -8));
  EXPECT_FALSE(meets(PortDemand{"a", {{-9, 9}}, 2}, -6));
  EXPECT_FALSE(meets(PortDemand{"a", {{-9, 9}}, 2}, 12));
}

TEST(Demands, ReadAsText) {
  const Demands demands{{{"d", {{1, 1}}}, {"a", {{-5, 5}}}, {"b", {{-9, -1}, {2, 2}}}}, {{"a", "b"}}};
  EXPECT_EQ(demand_text(demands, 0), "d = 1");
  EXPECT_EQ(demand_text(demands, 1), "a in [-5, 5]");
  EXPECT_EQ(demand_text(demands, 2), "b in [-9, -1] or 2");
  EXPECT_EQ(demand_text(demands, 3), "a <= b");
  EXPECT_EQ(demand_text({"a", {{-40, 40}}, 2}), "a in [-40, 40], a multiple of 4");
  EXPECT_EQ(demand_text({"a", {{-40, -1}, {8, 8}}, 3}), "a in [-40, -1] or 8, a multiple of 8");
  EXPECT_EQ(demand_text({"a", {{8, 8}}, 3}), "a = 8");
}

TEST(Demands, OneLeftOut) {
  const Demands demands{{{"a", {{0, 1}}}, {"d", {{1, 1}}}}, {{"a", "b"}}};
  EXPECT_EQ(demands.without(0), (Demands{{{"d", {{1, 1}}}}, {{"a", "b"}}}));
  EXPECT_EQ(demands.without(2), (Demands{{{"a", {{0, 1}}}, {"d", {{1, 1}}}}, {}}));
}

TEST(Promises, AreLegalAndAsHlsBoxSays) {
  for (const Design& design : designs()) {
    const Format format = design.default_format;
    check_demands(set_up_demands(design.ports(format)), design.ports(format));
  }
  const Demands of_slabs = set_up_demands(find_design("int_slabs").ports(hls::IntBits{24, 24}));
  EXPECT_EQ(of_slabs.ports.size(), 16U) << "all but rinf";
  EXPECT_EQ(demand_text(of_slabs.ports[0]), "irx in [-4194303, 4194303]");
  EXPECT_EQ(demand_text(of_slabs.ports[3]), "irlen in [0, 8388607]");
  EXPECT_EQ(demand_text(of_slabs.ports[4]), "iri_floor in [-8388607, 8388607]");
  EXPECT_EQ(demand_text(of_slabs.ports.back()), "izmax in [-4194304, 4194304]");
}

}  // namespace
}  // namespace hitpipe::rtl::demands_test
