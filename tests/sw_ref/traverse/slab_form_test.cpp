// The ways to a slab's distances that were measured (docs/safe_floats.md, "Fusion"): no form misses a box,
// each bound that one needs is needed, and a plain one answers as the unit's own software does.
#include "sw_ref/traverse/slab_form_test.hpp"

#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "sw_ref/adversary/categories.hpp"
#include "sw_ref/adversary/float_unit.hpp"
#include "sw_ref/adversary/neighbours.hpp"
#include "sw_ref/exact/box_referee.hpp"
#include "sw_ref/traverse/fp_slabs_safe.hpp"

namespace hitpipe::ref::slab_form_test {
namespace {

/// Calls judge(case, boxes) until it returns false.
template <class Judge>
void for_each_case(int rays, const Judge& judge) {
  adversary::Random random(7);
  std::vector<Aabb> boxes(16);
  for (const auto& categories : {adversary::categories(), adversary::float_unit_categories()}) {
    for (const adversary::Category& category : categories) {
      for (int i = 0; i < rays; ++i) {
        const adversary::Case c = category.make(random);
        adversary::neighbours(random, c.box, boxes);
        if (!judge(c, boxes)) return;
      }
    }
  }
}

/// The first box that a form misses.
template <class Test>
std::optional<std::string> first_miss(int rays) {
  std::optional<std::string> found;
  for_each_case(rays, [&](const adversary::Case& c, const std::vector<Aabb>& boxes) {
    const Test test(c.ray);
    const BoxReferee referee(c.ray);
    for (const Aabb& box : boxes)
      if (!test(Test::round(box)) && referee.meets(box)) found = to_text(adversary::Case{c.ray, box});
    return !found;
  });
  return found;
}

template <int E, int M>
void expect_no_miss() {
  EXPECT_EQ((first_miss<SlabFormTest<E, M, SlabForm::exact>>(60)), std::nullopt);
  EXPECT_EQ((first_miss<SlabFormTest<E, M, SlabForm::short_product, 1>>(60)), std::nullopt);
  EXPECT_EQ((first_miss<SlabFormTest<E, M, SlabForm::fused>>(60)), std::nullopt);
  EXPECT_EQ((first_miss<SlabFormTest<E, M, SlabForm::separate>>(60)), std::nullopt);
  EXPECT_EQ((first_miss<SlabFormTest<E, M, SlabForm::separate_fused>>(60)), std::nullopt);
}

TEST(SlabForms, MissNoBoxThatTheRayMeets) {
  expect_no_miss<8, 23>();
  expect_no_miss<8, 7>();
  expect_no_miss<5, 10>();
}

/// In some format.
template <SlabForm Form, LeftOut Bound>
bool misses_without() {
  return first_miss<SlabFormTest<8, 15, Form, 1, Bound>>(300) ||
         first_miss<SlabFormTest<5, 5, Form, 1, Bound>>(300) ||
         first_miss<SlabFormTest<4, 3, Form, 1, Bound>>(300);
}

TEST(SlabForms, NeedEachBound) {
  EXPECT_TRUE((misses_without<SlabForm::plain, LeftOut::factor>()));
  EXPECT_TRUE((misses_without<SlabForm::short_product, LeftOut::factor>()));
  EXPECT_TRUE((misses_without<SlabForm::fused, LeftOut::factor>()));
  EXPECT_TRUE((misses_without<SlabForm::separate, LeftOut::factor>()));
  EXPECT_TRUE((misses_without<SlabForm::separate, LeftOut::offset>()));
  EXPECT_TRUE((misses_without<SlabForm::separate_fused, LeftOut::offset>()));
}

TEST(SlabForms, PlainAnswersAsTheUnit) {
  int hits = 0;
  for_each_case(60, [&](const adversary::Case& c, const std::vector<Aabb>& boxes) {
    const FpSlabsSafeTest unit(c.ray, hls::AnyFpBits(5, 10));
    const SlabFormTest<5, 10, SlabForm::plain> plain(c.ray);
    for (const Aabb& box : boxes) {
      const bool hit = unit(round_box(box, hls::AnyFpBits(5, 10)));
      EXPECT_EQ(plain(plain.round(box)), hit) << to_text(adversary::Case{c.ray, box});
      hits += hit ? 1 : 0;
    }
    return !testing::Test::HasFailure();
  });
  EXPECT_GT(hits, 10'000);
}

}  // namespace
}  // namespace hitpipe::ref::slab_form_test
