// The triangle unit against exact integers, and faults that the check must catch.
#include "sim/check/triangle_check.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <string>

#include <gtest/gtest.h>

#include "sim/software/software.hpp"
#include "tests/sim/check/triangle_units.hpp"

namespace hitpipe::sim::triangle_check_test {
namespace {

using ref::IntCrossing;
using namespace triangle_units;

TEST(TriangleCheck, PiecesTogetherAreTheWhole) {
  const auto counts = [](const TriangleCategoryResult& sum) {
    return std::array{sum.tests, sum.hits, sum.wrong};
  };
  const auto make = [] { return unit("16+1s16"); };
  TriangleCategoryResult sum;
  for (std::uint64_t number = 1; number <= 5; ++number) sum += sum_of(make, 60'001, {number, 5});
  EXPECT_EQ(counts(sum), counts(sum_of(make, 60'001)));
}

class Formats : public testing::TestWithParam<std::string> {};

TEST_P(Formats, AreExact) {
  const TriangleCategoryResult sum = sum_of([] { return unit(GetParam()); }, 120'000);
  EXPECT_EQ(sum.wrong, 0U);
  EXPECT_GT(sum.hits, 20'000U);
  const bool crossings = GetParam().find('c') != std::string::npos;
  EXPECT_EQ(sum.ties > 10'000, crossings);
  EXPECT_EQ(sum.counted > 2'000, crossings);
}

INSTANTIATE_TEST_SUITE_P(Widths, Formats,
                         testing::Values("8+0s8b1", "8+3s32t8b1", "16+1s16", "20+1s20", "20+1s20t4b1",
                                         "22+1s20b1", "24+3s32t8b1", "8+0s8c1", "20+1s20c1", "24+3s32t8b1c1",
                                         "8+0s8c2", "16+1s16c2", "20+1s20c2", "24+3s32t8b1c2"));

/// A unit with a fault in an operand, or in what is made of the results.
class Faulty final : public Own {
 public:
  using Operand = std::function<void(const std::vector<rtl::Port>&, std::int64_t*)>;
  using Answer = std::function<std::optional<IntCrossing>(const IntCrossing&)>;

  Faulty(Operand operand, Answer answer)
      : Own("20+1s20b1"),
        ports_(rtl::find_design("int_triangle")
                   .ports(rtl::find_design("int_triangle").parse_format("20+1s20b1"))),
        operand_(std::move(operand)),
        answer_(std::move(answer)) {}

  void operands(const ref::IntTriangle& triangle, std::int64_t* out) const override {
    Own::operands(triangle, out);
    if (operand_) operand_(ports_, out);
  }
  [[nodiscard]] std::optional<IntCrossing> crossing(const std::int64_t* results) const override {
    const auto right = Own::crossing(results);
    return right && answer_ ? answer_(*right) : right;
  }

 private:
  std::vector<rtl::Port> ports_;
  Operand operand_;
  Answer answer_;
};

std::size_t place(const std::vector<rtl::Port>& ports, const std::string& name) {
  return rtl::index_of(ports, name).value();
}

struct Fault {
  std::string name;
  Faulty::Operand operand;
  Faulty::Answer answer;
};

/// A corner and an origin have a bit that the cube leaves unused, so they lose two.
Fault too_narrow(const std::string& port, int bits) {
  return {"too_narrow_" + port,
          [port, bits](const auto& ports, std::int64_t* out) {
            const std::size_t at = place(ports, port);
            out[at] = hls::sign_extended(static_cast<std::uint64_t>(out[at]), ports[at].width - bits);
          },
          {}};
}

std::vector<Fault> faults() {
  std::vector<Fault> all;
  for (const char* port : {"slope_a", "slope_b"}) all.push_back(too_narrow(port, 1));
  for (const char* port : {"origin_m", "origin_a", "origin_b", "x0", "y1", "z2"})
    all.push_back(too_narrow(port, 2));
  all.push_back({"swapped_axes",
                 [](const auto& ports, std::int64_t* out) {
                   std::swap(out[place(ports, "y0")], out[place(ports, "z0")]);
                 },
                 {}});
  all.push_back(
      {"turned_sign", [](const auto& ports, std::int64_t* out) { out[place(ports, "back_m")] ^= 1; }, {}});
  all.push_back({"open_edges", {}, [](const IntCrossing& right) -> std::optional<IntCrossing> {
                   if (*std::min_element(right.e.begin(), right.e.end()) == 0) return std::nullopt;
                   return right;
                 }});
  all.push_back({"rounded_edges", {}, [](IntCrossing right) -> std::optional<IntCrossing> {
                   right.e[1] &= ~ref::Int128{3};
                   return right;
                 }});
  all.push_back({"t_at_0_missed", {}, [](const IntCrossing& right) -> std::optional<IntCrossing> {
                   if (right.t == 0) return std::nullopt;
                   return right;
                 }});
  return all;
}

/// The value has fewer bits. It is the low part of a wider one, of which others may read some bits too.
DatapathFault narrower(const std::string& value, int bits) {
  const rtl::Graph right = traced();
  rtl::NodeId named = 0;
  while (right[named].name != value || right[named].op != rtl::Op::slice) ++named;
  const rtl::NodeId wider = right[named].args[0];
  const int left = right[named].width - bits;
  return {"narrower_" + value, [wider, left](rtl::Graph& to, const rtl::Node& node, Args args) {
            if (node.op != rtl::Op::slice || node.args[0] != wider) return rtl::no_node;
            const rtl::NodeId low = to.slice(args[0], left - 1, 0);
            return to.slice(to.extend(low, to[args[0]].width, true), node.low + node.width - 1, node.low);
          }};
}

/// One bit less in each width. The corners span a cube, so areas c and the volume num use half of the range
/// that four products of three components need: they lose two.
std::vector<DatapathFault> datapath_faults() {
  std::vector<DatapathFault> all;
  for (const char* value : {"e1_m", "e1_a", "e1_b", "e2_m", "e2_a", "e2_b", "q_m", "q_a", "q_b", "p_m", "p_a",
                            "p_b", "det", "u", "v", "e0"})
    all.push_back(narrower(value, 1));
  for (const char* value : {"c_m", "c_a", "c_b", "num"}) all.push_back(narrower(value, 2));
  for (const char* test : {"passes_0", "passes_u", "passes_v", "ahead"}) {
    const auto at = [test = std::string(test)](const rtl::Node& node) {
      return node.name == test && node.op == rtl::Op::bit_or;
    };
    all.push_back({std::string("wrong_way_") + test, [at](rtl::Graph& to, const rtl::Node& node, Args args) {
                     return at(node) ? to.binary(rtl::Op::bit_or, to.invert(args[0]), args[1]) : rtl::no_node;
                   }});
    all.push_back({std::string("open_") + test, [at](rtl::Graph& /*to*/, const rtl::Node& node, Args args) {
                     return at(node) ? args[0] : rtl::no_node;
                   }});
  }
  return all;
}

class DatapathFaults : public testing::TestWithParam<DatapathFault> {};

TEST_P(DatapathFaults, AreFound) {
  const auto make = [&] { return std::make_unique<FaultyDatapath>(GetParam().fault); };
  EXPECT_GT(sum_of(make, 24'000).wrong, 0U);
}

INSTANTIATE_TEST_SUITE_P(Each, DatapathFaults, testing::ValuesIn(datapath_faults()),
                         [](const auto& one) { return one.param.name; });

/// So the faults cause what they show, and not the copy of the datapath. One bit of c and num is to spare.
TEST(DatapathFaults, ACopyIsExact) {
  for (const char* value : {"det", "c_m", "c_a", "c_b", "num"}) {
    const bool spare = std::string(value) != "det";
    const auto fault =
        spare ? narrower(value, 1).fault : [](rtl::Graph& to, const rtl::Node& node, Args args) {
          return node.name == "det" ? copied(to, node, args) : rtl::no_node;
        };
    EXPECT_EQ(sum_of([&] { return std::make_unique<FaultyDatapath>(fault); }, 24'000).wrong, 0U) << value;
  }
}

class Faults : public testing::TestWithParam<Fault> {};

TEST_P(Faults, AreFound) {
  const Fault& fault = GetParam();
  const auto make = [&] { return std::make_unique<Faulty>(fault.operand, fault.answer); };
  EXPECT_GT(sum_of(make, 24'000).wrong, 0U);
}

INSTANTIATE_TEST_SUITE_P(Each, Faults, testing::ValuesIn(faults()),
                         [](const auto& one) { return one.param.name; });

TEST(TriangleCheck, ThreadsChangeNothing) {
  TriangleCheckOptions options;
  const auto all = ref::int_categories(unit("12+1s12")->world());
  options.categories = {all.begin(), all.end()};
  options.tests = 30'000;
  const auto hits = [&](int threads) {
    options.threads = threads;
    std::vector<std::uint64_t> each;
    for (const auto& result : check_triangles([] { return unit("12+1s12"); }, options))
      each.push_back(result.hits);
    return each;
  };
  EXPECT_EQ(hits(1), hits(2));
}

TEST(TriangleCheck, AFormatSaysWhichResultsThereAre) {
  const rtl::Design& design = rtl::find_design("int_triangle");
  const auto last_two = [&](const std::string& bits) {
    const auto results = design.results(design.parse_format(bits));
    return std::string(results.at(results.size() - 2).name) + " " + results.back().name;
  };
  EXPECT_EQ(last_two("20+1s20"), "num_high num_low");
  EXPECT_EQ(last_two("20+1s20b1"), "v_high v_low");
  EXPECT_EQ(last_two("20+1s20c1"), "tie side");
  EXPECT_EQ(last_two("20+1s20t2b1c2"), "once side");
  EXPECT_EQ(last_two("20+1s20c3"), "zero inner");
  EXPECT_EQ(to_string(design.parse_format("20+1s20c2")), "20+1s20c2");
  EXPECT_EQ(design.parse_format("20+1s20c2").type(), "WorldFormat<20, 1, 20, 0, 0, 2>");
  for (const char* bits : {"20+1s20c4", "20+1s20c", "20+1s20c1b1"})
    EXPECT_THROW((void)design.parse_format(bits), std::runtime_error) << bits;
}

TEST(TriangleCheck, ABoxUnitHasNoTriangles) {
  const rtl::Design& design = rtl::find_design("int_slabs");
  EXPECT_THROW((void)make_triangle_test(design, design.default_format), std::runtime_error);
}

}  // namespace
}  // namespace hitpipe::sim::triangle_check_test
