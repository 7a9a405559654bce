// A shrunk case still fails, is acceptable, and cannot be made simpler.
#include <cmath>

#include <gtest/gtest.h>

#include "rays/exact/box_referee.hpp"
#include "sw_ref/judge/adversary/case.hpp"
#include "tests/sw_ref/judge/adversary/each_case.hpp"

namespace hitpipe::ref::adversary::shrink_test {
namespace {

constexpr std::uint64_t seed = 20074;

const Case odd{
    .ray = {{0x1.23456p-3F, -0x1.789abcp-2F, 0x1.11111p-1F},
            {0x1.abcdefp+3F, -0x1.13579p-20F, 0x1.fedcbap-5F},
            0x1.2468acp+9F},
    .box = {{-0x1.54321p-2F, -0x1.98765p-1F, 0x1.13579p-3F}, {0x1.54321p-2F, 0x1.98765p-1F, 0x1.97531p-1F}}};

/// Numbers other than 0, +-1, +-1/2 and an infinite length.
int numbers_to_read(const Case& c) {
  int count = 0;
  for (const float x : {c.ray.origin.x, c.ray.origin.y, c.ray.origin.z, c.ray.direction.x, c.ray.direction.y,
                        c.ray.direction.z, c.ray.length, c.box.min.x, c.box.min.y, c.box.min.z, c.box.max.x,
                        c.box.max.y, c.box.max.z}) {
    const float size = std::abs(x);
    count += size != 0 && size != 0.5F && size != 1 && !std::isinf(size) ? 1 : 0;
  }
  return count;
}

TEST(Shrink, OfWhatAlwaysFailsLeavesNothingToRead) {
  const Case simple = shrink(odd, [](const Case&) { return true; });
  EXPECT_TRUE(acceptable(simple.ray));
  EXPECT_TRUE(acceptable(simple.box));
  EXPECT_EQ(numbers_to_read(simple), 0) << to_text(simple);
  EXPECT_TRUE(simple.ray.is_infinite());
}

/// If one number alone decides, it keeps only the bits that matter.
TEST(Shrink, KeepsTheOneNumberThatFails) {
  const Case simple = shrink(
      odd, [](const Case& c) { return c.ray.direction.x > 0x1.abp+3F && c.ray.direction.x < 0x1.bp+3F; });
  EXPECT_EQ(simple.ray.direction.x, 0x1.acp+3F) << to_text(simple);
  EXPECT_EQ(numbers_to_read(simple), 1) << to_text(simple);
}

TEST(Shrink, KeepsAFiniteLengthThatFails) {
  const Case simple = shrink(odd, [](const Case& c) { return c.ray.length < 1'000.0F; });
  EXPECT_EQ(simple.ray.length, 0.0F);
}

TEST(Shrink, StopsAtWhatIsSimpleAlready) {
  const Case simple = shrink(odd, [](const Case&) { return true; });
  EXPECT_EQ(to_text(shrink(simple, [](const Case&) { return true; })), to_text(simple));
}

/// The last case fails, and so does every case on the way; none is refused.
TEST(Shrink, AsksOnlyAboutAcceptableCasesAndEndsAtOneThatFails) {
  Random random(seed);
  each_case(random, 20, [](const Case& drawn) {
    const bool meets = ray_meets_box(drawn.ray, drawn.box);
    const auto same = [&](const Case& c) {
      EXPECT_TRUE(acceptable(c.ray) && acceptable(c.box)) << to_text(c);
      return ray_meets_box(c.ray, c.box) == meets;
    };
    const Case simple = shrink(drawn, same);
    EXPECT_TRUE(same(simple)) << to_text(simple);
    EXPECT_LE(numbers_to_read(simple), 3) << to_text(simple);
  });
}

}  // namespace
}  // namespace hitpipe::ref::adversary::shrink_test
