// A triangle unit that says ties or crossings, against exact integers, and faults that the check must catch.
#include <algorithm>
#include <array>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/sim/check/triangle_units.hpp"

namespace hitpipe::sim::triangle_crossings_test {
namespace {

using namespace triangle_units;

/// A unit that says the other side.
class OtherSide final : public Own {
 public:
  OtherSide() : Own("20+1s20c1") {}

  [[nodiscard]] CrossingFlags crossing_flags(const std::int64_t* results) const override {
    CrossingFlags flags = Own::crossing_flags(results);
    flags.side = -flags.side;
    return flags;
  }
};

/// Counts the ties of a unit's tests by the branch of the rule that answers, and passes everything on.
class Branches final : public Own {
 public:
  struct Counts {
    /// Ties by which of u, v and e0 is 0, and by what decides: the component along slot a, or that along slot b.
    std::array<std::array<int, 2>, 3> edges{};
    int corners = 0;  ///< two of them are 0
  };

  explicit Branches(Counts& counts) : Own("20+1s20b1c2"), counts_(counts) {}

  void start(const ref::IntRay& ray) override {
    Own::start(ray);
    ray_ = ray;
  }
  void operands(const ref::IntTriangle& triangle, std::int64_t* out) const override {
    Own::operands(triangle, out);
    const auto hit = ref::int_crossing(ray_, triangle, world());
    if (!hit) return;
    const std::size_t a = ray_.major == 1 ? 0 : 1;
    int zeros = 0;
    for (std::size_t edge = 0; edge < 3; ++edge) {
      const std::size_t opposite = (edge + 1) % 3;  // u is of corner 1, v of corner 2, e0 of corner 0
      if (hit->e[opposite] != 0) continue;
      ++zeros;
      std::array<ref::Int128, 3> way{};
      for (std::size_t axis = 0; axis < 3; ++axis)
        way[axis] = triangle.corners[(opposite + 2) % 3][axis] - triangle.corners[(opposite + 1) % 3][axis];
      const std::size_t b = (a + 1) % 3, c = (a + 2) % 3;
      ++counts_.edges[edge][ray_.direction[b] * way[c] == ray_.direction[c] * way[b] ? 1 : 0];
    }
    counts_.corners += zeros == 2 ? 1 : 0;
  }

 private:
  Counts& counts_;
  ref::IntRay ray_{};
};

TEST(TriangleCrossings, TiesReachEachBranchOfTheRule) {
  Branches::Counts counts;
  TriangleCheckOptions options;
  const auto all = ref::int_categories(unit("20+1s20c2")->world());
  options.categories = {all.begin(), all.end()};
  options.tests = 120'000;
  options.threads = 1;
  for (const TriangleCategoryResult& each :
       check_triangles([&] { return std::make_unique<Branches>(counts); }, options)) {
    EXPECT_EQ(each.wrong, 0U) << each.category;
    if (each.category == "tie" || each.category == "edge_on" || each.category == "edge" ||
        each.category == "corner") {
      EXPECT_GT(each.ties, 500U) << each.category;
      EXPECT_GT(each.counted, 100U) << each.category;
    }
  }
  for (const auto& edge : counts.edges)
    for (const int count : edge) EXPECT_GT(count, 300);
  EXPECT_GT(counts.corners, 1'000);
}

bool is_named(const rtl::Node& node, const char* name, rtl::Op op) {
  return node.op == op && node.name == name;
}

/// Of the rule. `edges` are names of its three choices: what the other component and det tell, or the sign of
/// the component along slot a.
DatapathFault in_choices(const std::string& name, const std::vector<const char*>& edges,
                         const std::function<rtl::NodeId(rtl::Graph&, Args)>& choice) {
  return {name, [edges, choice](rtl::Graph& to, const rtl::Node& node, Args args) {
            const bool is_one = std::any_of(edges.begin(), edges.end(), [&](const char* edge) {
              return is_named(node, edge, rtl::Op::mux);
            });
            return is_one ? choice(to, args) : rtl::no_node;
          }};
}

const std::vector<const char*> all_edges{"ok_u", "ok_v", "ok_0"};

/// Rules of tests/rays/world/crossing_test.cpp that are a little different, and others.
std::vector<DatapathFault> rule_faults() {
  std::vector<DatapathFault> all;
  all.push_back(in_choices("closed", all_edges, [](rtl::Graph& to, Args) { return to.constant(1, 1); }));
  all.push_back(in_choices("one_component", all_edges, [](rtl::Graph& to, Args args) {
    return to.mux(args[0], to.constant(1, 1), args[2]);
  }));
  all.push_back(in_choices("fixed_answer", all_edges, [](rtl::Graph& to, Args args) {
    return to.mux(args[0], to.constant(1, 0), args[2]);
  }));
  for (const char* edge : all_edges) {
    all.push_back(in_choices(std::string("turned_slot_a_") + edge, {edge}, [](rtl::Graph& to, Args args) {
      return to.mux(args[0], args[1], to.invert(args[2]));
    }));
    all.push_back(in_choices(std::string("turned_slot_b_") + edge, {edge}, [](rtl::Graph& to, Args args) {
      return to.mux(args[0], to.invert(args[1]), args[2]);
    }));
    all.push_back(in_choices(std::string("slot_b_first_") + edge, {edge},
                             [](rtl::Graph& /*to*/, Args args) { return args[1]; }));
  }
  return all;
}

/// D x K is replaced by K itself, so R_a and P_a are -e1_b and -e2_b.
DatapathFault own_components() {
  struct Places {
    rtl::Node p, r;                  ///< the wide differences
    std::array<rtl::NodeId, 2> p_a;  ///< and the value that is a part of it
  };
  const rtl::Graph right = traced("20+1s20c2");
  const auto part = [&](const char* name) {
    rtl::NodeId id = 0;
    while (!is_named(right[id], name, rtl::Op::slice)) ++id;
    return id;
  };
  const rtl::NodeId p = part("p_a"), wide = right[p].args[0];
  const Places places{right[wide], right[right[part("r_a")].args[0]], {p, wide}};
  const auto own = std::make_shared<rtl::NodeId>();
  return {"own_components", [places, own](rtl::Graph& to, const rtl::Node& node, Args args) {
            const auto without_slope = [&] {
              return to.binary(rtl::Op::sub, to.constant(node.width, 0), args[1]);
            };
            const auto is = [&](const rtl::Node& other) {
              return node.op == other.op && node.args == other.args && node.width == other.width;
            };
            const auto of_p = [&](std::size_t i) {
              return node.args[i] == places.p_a[0] || node.args[i] == places.p_a[1];
            };
            const auto fits = [&](rtl::NodeId as) { return to.slice(*own, to[as].width - 1, 0); };
            if (is(places.r)) return without_slope();
            if (is(places.p)) *own = without_slope();
            if (node.op == rtl::Op::slice && node.width == 1 && of_p(0))
              return to.slice(*own, node.low, node.low);
            if ((node.op == rtl::Op::equal || node.op == rtl::Op::less) && (of_p(0) || of_p(1)))
              return to.binary(node.op, of_p(0) ? fits(args[0]) : args[0], of_p(1) ? fits(args[1]) : args[1],
                               node.is_signed);
            return rtl::no_node;
          }};
}

/// Of a unit with "c1" or "c2".
struct CrossingFault {
  const char* bits;
  DatapathFault fault;
};

void PrintTo(const CrossingFault& fault, std::ostream* out) {
  *out << fault.fault.name;
}

std::vector<CrossingFault> crossing_faults() {
  std::vector<CrossingFault> all;
  for (const DatapathFault& each : rule_faults()) all.push_back({"20+1s20c2", each});
  all.push_back({"20+1s20c2", own_components()});
  const auto node_called = [](const rtl::Graph& graph, const char* name) {
    rtl::NodeId id = 0;
    while (!is_named(graph[id], name, rtl::Op::bit_and)) ++id;
    return graph[id];
  };
  const auto drop = [](const rtl::Node& from, std::size_t left) -> std::function<GraphFault> {
    return [from, left](rtl::Graph& /*to*/, const rtl::Node& node, Args args) {
      return node.op == from.op && node.args == from.args ? args[left] : rtl::no_node;
    };
  };
  // tie = hit & ~((u != 0 & v != 0) & e0 != 0)
  const rtl::Graph ties = traced("20+1s20c1");
  const rtl::Node tie = node_called(ties, "tie"), all_three = ties[ties[tie.args[1]].args[0]],
                  u_and_v = ties[all_three.args[0]];
  all.push_back({"20+1s20c1", {"tie_without_hit", drop(tie, 1)}});
  all.push_back({"20+1s20c1", {"no_tie_at_e0", drop(all_three, 0)}});
  all.push_back({"20+1s20c1", {"no_tie_at_v", drop(u_and_v, 0)}});
  all.push_back({"20+1s20c1", {"no_tie_at_u", drop(u_and_v, 1)}});
  // once = ((hit & of u) & of v) & of e0
  const rtl::Graph counts = traced("20+1s20c2");
  const rtl::Node once = node_called(counts, "once"), of_v = counts[once.args[0]],
                  of_u = counts[of_v.args[0]];
  all.push_back({"20+1s20c2", {"e0_always_counts", drop(once, 0)}});
  all.push_back({"20+1s20c2", {"v_always_counts", drop(of_v, 0)}});
  all.push_back({"20+1s20c2", {"u_always_counts", drop(of_u, 0)}});
  all.push_back({"20+1s20c2", {"once_without_hit", drop(of_u, 1)}});
  return all;
}

class CrossingFaults : public testing::TestWithParam<CrossingFault> {};

TEST_P(CrossingFaults, AreFound) {
  const auto make = [&] { return std::make_unique<FaultyDatapath>(GetParam().fault.fault, GetParam().bits); };
  EXPECT_GT(sum_of(make, 28'000).wrong, 0U);
}

TEST(TriangleCrossings, TheOtherSideIsFound) {
  EXPECT_GT(sum_of([] { return std::make_unique<OtherSide>(); }, 28'000).wrong, 0U);
}

INSTANTIATE_TEST_SUITE_P(Each, CrossingFaults, testing::ValuesIn(crossing_faults()),
                         [](const auto& one) { return one.param.fault.name; });

TEST(TriangleCrossings, ACopyWithCrossingsIsExact) {
  for (const char* bits : {"20+1s20c1", "20+1s20c2"}) {
    const auto fault = [](rtl::Graph& to, const rtl::Node& node, Args args) {
      return node.name == "meets" ? copied(to, node, args) : rtl::no_node;
    };
    EXPECT_EQ(sum_of([&] { return std::make_unique<FaultyDatapath>(fault, bits); }, 28'000).wrong, 0U)
        << bits;
  }
}

}  // namespace
}  // namespace hitpipe::sim::triangle_crossings_test
