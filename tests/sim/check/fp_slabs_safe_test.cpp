// The float unit that never misses: in many formats and all categories it misses no box, and the box test of
// its software traversal gives the same answers, also after a cut. Each step of the set-up is needed.
#include "sw_ref/trace/fp_slabs_safe.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "hls/box/fp_format.hpp"
#include "rays/exact/box_referee.hpp"
#include "sim/software/box_software.hpp"
#include "sw_ref/judge/adversary/categories.hpp"
#include "sw_ref/quantise/fp_box.hpp"

namespace hitpipe::sim::fp_slabs_safe_test {
namespace {

using hls::FpBits;
using ref::adversary::Case;
using ref::adversary::Category;

constexpr std::uint64_t seed = 20092;

const rtl::Design& safe_design() {
  return rtl::find_design("fp_slabs_safe");
}

std::vector<Category> categories_of_floats() {
  const auto usual = ref::adversary::categories();
  const auto own = ref::adversary::float_unit_categories();
  std::vector<Category> all(usual.begin(), usual.end());
  all.insert(all.end(), own.begin(), own.end());
  return all;
}

class FpSlabsSafe : public testing::TestWithParam<FpBits> {};

TEST_P(FpSlabsSafe, NeverMissesAndItsSoftwareAgrees) {
  const FpBits bits = GetParam();
  const auto unit = make_box_test(safe_design(), bits);
  ref::adversary::Random random(seed);
  int tests = 0;
  int false_hits = 0;
  int hits = 0;
  for (const Category& category : categories_of_floats()) {
    for (int i = 0; i < 400; ++i) {
      Case c = category.make(random);
      ref::FpSlabsSafeTest software(c.ray, bits);
      for (const bool cut : {false, true}) {
        if (cut) {
          c.ray.length = std::min(c.ray.length, std::abs(random.signed_unit()) * 2.0F);
          software.cut(c.ray.length);
        }
        unit->start(c.ray);
        const bool hit = unit->hit(c.box);
        const bool meets = ref::ray_meets_box(c.ray, c.box);
        ASSERT_TRUE(hit || !meets) << category.name << " " << to_text(c);
        ASSERT_EQ(software(ref::round_box(c.box, bits)), hit) << category.name << " " << to_text(c);
        ++tests;
        hits += meets ? 1 : 0;
        false_hits += hit && !meets ? 1 : 0;
      }
    }
  }
  fmt::print("{} tests, {} hits, {} false hits\n", tests, hits, false_hits);
  EXPECT_GT(hits, tests / 5);
}

INSTANTIATE_TEST_SUITE_P(Formats, FpSlabsSafe,
                         testing::Values(FpBits{8, 23}, FpBits{8, 15}, FpBits{8, 7}, FpBits{5, 10},
                                         FpBits{6, 13}, FpBits{3, 2}, FpBits{2, 1}, FpBits{8, 1},
                                         FpBits{2, 23}, FpBits{7, 22}),
                         [](const auto& p) {
                           return fmt::format("e{}m{}", p.param.exponent, p.param.fraction);
                         });

/// Answers for operands of a case that `change` has changed.
template <class Change>
bool hit_with(const FpBits& bits, const Case& c, const Change& change) {
  const auto unit = make_box_test(safe_design(), bits);
  unit->start(c.ray);
  (void)unit->hit(c.box);
  std::vector<std::int64_t> operands(unit->operands().begin(), unit->operands().end());
  const std::vector<rtl::Port> ports = safe_design().ports(bits);
  for (std::size_t i = 0; i < ports.size(); ++i) change(ports[i], operands[i]);
  return safe_design().evaluate(bits)(operands.data());
}

const auto no_change = [](const rtl::Port&, std::int64_t&) {};

/// True if a change of operands makes the unit miss a box of a category that the ray meets.
template <class Change>
bool some_false_miss(const FpBits& bits, const Change& change) {
  ref::adversary::Random random(seed);
  const auto all = categories_of_floats();
  for (int i = 0; i < 40'000; ++i) {
    const Case c = all[random.below(all.size())].make(random);
    if (ref::ray_meets_box(c.ray, c.box) && !hit_with(bits, c, change)) return true;
  }
  return false;
}

TEST(FpSlabsSafeSetup, ZerosOfTheWrongSignMiss) {
  const FpBits bits{8, 15};
  const Case c{{glm::vec3(-0.0F, 0.0F, 0.0F), glm::vec3(-1.0F, 0.5F, 0.0F), ref::Ray::infinite},
               {glm::vec3(0.0F), glm::vec3(0.0F)}};
  EXPECT_TRUE(hit_with(bits, c, no_change));
  EXPECT_FALSE(hit_with(bits, c, [&](const rtl::Port& port, std::int64_t& operand) {
    if (port.role == hls::Role::plane_low && operand == std::int64_t{1} << (bits.width() - 1)) operand = 0;
  }));
}

TEST(FpSlabsSafeSetup, EachStepIsNeeded) {
  const FpBits bits{8, 15};
  EXPECT_FALSE(some_false_miss(bits, no_change));
  using hls::Role;
  EXPECT_TRUE(some_false_miss(bits, [&](const rtl::Port& port, std::int64_t& operand) {
    if (port.role == Role::inverse_low && operand < bits.infinity() - 1) ++operand;
  }));
  // The upper bound of the inverse alone, which does not make up for what the unit cuts.
  std::int64_t low = 0;
  EXPECT_TRUE(some_false_miss(bits, [&](const rtl::Port& port, std::int64_t& operand) {
    if (port.role == Role::inverse_low) low = operand;
    if (port.role == Role::inverse_high) operand = std::min(low + 1, bits.infinity());
  }));
  EXPECT_TRUE(some_false_miss(bits, [&](const rtl::Port& port, std::int64_t& operand) {
    if (port.role == Role::length && operand > 0 && operand < bits.infinity()) --operand;
  }));
  // One number down: that is towards 0, or away from it for a negative number.
  EXPECT_TRUE(some_false_miss(bits, [&](const rtl::Port& port, std::int64_t& operand) {
    const std::int64_t zero = operand & ((std::int64_t{1} << (bits.width() - 1)) - 1);
    if (port.role == Role::origin_high && zero != 0) operand += operand != zero ? 1 : -1;
  }));
}

}  // namespace
}  // namespace hitpipe::sim::fp_slabs_safe_test
