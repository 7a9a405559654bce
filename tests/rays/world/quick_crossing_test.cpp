// The quick tests of triangles are the definitions, in every format.
#include "rays/world/quick_crossing.hpp"

#include <gtest/gtest.h>

#include "tests/rays/world/cases.hpp"

namespace hitpipe::ref::quick_crossing_test {
namespace {

TEST(QuickCrossing, IsTheDefinition) {
  world_cases::Draw draw(39301);
  constexpr std::array<hls::WorldBits, 7> formats{
      {{20, 1, 20}, {8, 0, 8}, {20, 1, 20, 8}, {16, 3, 16, 2}, {19, 3, 20}, {20, 2, 19}, {14, 1, 32, 8}}};
  int hits = 0;
  int ties = 0;
  int at_length = 0;
  for (int i = 0; i < 400'000; ++i) {
    const hls::WorldBits bits = i % 2 == 0 ? draw.pick(formats) : draw.bits();
    const IntTriangle triangle = draw.triangle(bits);
    IntRay ray = draw.ray(bits, triangle);
    const QuickCrossing quick(bits);
    if (draw.one_in(4)) {
      ray.length = bits.largest_distance();
      // Up to where it hits, or one less.
      if (const auto hit = int_crossing(ray, triangle, bits))
        ray.length = std::max<std::int64_t>(0, hit->t - draw.integer(0, 1));
      ++at_length;
    }
    const auto right = crossing_of(ray, triangle, bits);
    const auto found = quick.crossing(ray, triangle);
    ASSERT_EQ(found.has_value(), right.has_value()) << i;
    ASSERT_EQ(quick.distance(ray, triangle).has_value(), right.has_value()) << i;
    if (!right) continue;
    ASSERT_EQ(quick.distance(ray, triangle), right->t) << i;
    ASSERT_EQ(found->t, right->t) << i;
    ASSERT_EQ(found->side, right->side) << i;
    ASSERT_EQ(found->tie, right->tie) << i;
    ASSERT_EQ(found->once, right->once) << i;
    ++hits;
    ties += right->tie ? 1 : 0;
  }
  EXPECT_GT(hits, 40'000);
  EXPECT_GT(ties, 2'000);
  EXPECT_GT(at_length, 10'000);
}

}  // namespace
}  // namespace hitpipe::ref::quick_crossing_test
