// The triangle unit against exact integers, and faults that the check must catch.
#include "sim/check/triangle_check.hpp"

#include <algorithm>
#include <functional>
#include <string>

#include <gtest/gtest.h>

#include "hls/num/bits.hpp"
#include "sim/software.hpp"

namespace hitpipe::sim::triangle_check_test {
namespace {

using hls::WorldBits;
using ref::IntCrossing;

TriangleCategoryResult sum_of(const MakeTriangleTest& make, std::uint64_t tests) {
  TriangleCheckOptions options;
  const auto all = ref::int_categories();
  options.categories = {all.begin(), all.end()};
  options.tests = tests;
  TriangleCategoryResult sum;
  for (const TriangleCategoryResult& each : check_triangles(make, options)) sum += each;
  return sum;
}

std::unique_ptr<TriangleTest> unit(const std::string& bits) {
  const rtl::Design& design = rtl::find_design("int_triangle");
  return make_triangle_test(design, design.parse_format(bits));
}

class Formats : public testing::TestWithParam<std::string> {};

TEST_P(Formats, AreExact) {
  const TriangleCategoryResult sum = sum_of([] { return unit(GetParam()); }, 110'000);
  EXPECT_EQ(sum.wrong, 0U);
  EXPECT_GT(sum.hits, 20'000U);
}

INSTANTIATE_TEST_SUITE_P(Widths, Formats,
                         testing::Values("8+0s8b1", "8+3s32t8b1", "16+1s16", "20+1s20", "20+1s20t4b1",
                                         "22+1s20b1", "24+3s32t8b1"));

/// A unit with a fault in an operand, or in what is made of the results.
class Faulty final : public TriangleTest {
 public:
  using Operand = std::function<void(const std::vector<rtl::Port>&, std::int64_t*)>;
  using Answer = std::function<std::optional<IntCrossing>(const IntCrossing&)>;

  Faulty(Operand operand, Answer answer)
      : own_(unit("20+1s20b1")),
        ports_(rtl::find_design("int_triangle")
                   .ports(rtl::find_design("int_triangle").parse_format("20+1s20b1"))),
        operand_(std::move(operand)),
        answer_(std::move(answer)) {}

  [[nodiscard]] const WorldBits& world() const override { return own_->world(); }
  [[nodiscard]] std::size_t operand_count() const override { return own_->operand_count(); }
  void start(const ref::IntRay& ray) override { own_->start(ray); }
  void operands(const ref::IntTriangle& triangle, std::int64_t* out) const override {
    own_->operands(triangle, out);
    if (operand_) operand_(ports_, out);
  }
  [[nodiscard]] std::optional<IntCrossing> crossing(const std::int64_t* results) const override {
    const auto right = own_->crossing(results);
    return right && answer_ ? answer_(*right) : right;
  }
  [[nodiscard]] const rtl::Evaluate& evaluate() const override { return own_->evaluate(); }

 private:
  std::unique_ptr<TriangleTest> own_;
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

class Faults : public testing::TestWithParam<Fault> {};

TEST_P(Faults, AreFound) {
  const Fault& fault = GetParam();
  const auto make = [&] { return std::make_unique<Faulty>(fault.operand, fault.answer); };
  EXPECT_GT(sum_of(make, 22'000).wrong, 0U);
}

INSTANTIATE_TEST_SUITE_P(Each, Faults, testing::ValuesIn(faults()),
                         [](const auto& one) { return one.param.name; });

TEST(TriangleCheck, ThreadsChangeNothing) {
  TriangleCheckOptions options;
  const auto all = ref::int_categories();
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

TEST(TriangleCheck, ABoxUnitHasNoTriangles) {
  const rtl::Design& design = rtl::find_design("int_slabs");
  EXPECT_THROW((void)make_triangle_test(design, design.default_format), std::runtime_error);
}

}  // namespace
}  // namespace hitpipe::sim::triangle_check_test
