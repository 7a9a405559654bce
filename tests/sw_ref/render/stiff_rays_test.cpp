#include "sw_ref/render/stiff_rays.hpp"

#include <array>

#include <gtest/gtest.h>

namespace hitpipe::ref::stiff_rays_test {
namespace {

Ray along(float x, float y, float z) {
  return {{0.0F, 0.0F, 0.0F}, {x, y, z}, Ray::infinite};
}

TEST(StiffRays, BeginBelowTheRatio) {
  EXPECT_FALSE(is_stiff(along(1.0F, -0x1p-10F, 1.0F)));
  EXPECT_TRUE(is_stiff(along(1.0F, -0x1.FFFFFEp-11F, 1.0F)));
  EXPECT_TRUE(is_stiff(along(0x1p-20F, 0x1p-20F, -0x1p-9F)));
  EXPECT_FALSE(is_stiff(along(0x1p-20F, 0x1p-20F, -0x1p-20F)));
  EXPECT_TRUE(is_stiff(along(0.0F, -1.0F, 1.0F)));
}

TEST(StiffRays, ZeroHasTwoSigns) {
  EXPECT_TRUE(has_zero_component(along(1.0F, 1.0F, -0.0F)));
  EXPECT_TRUE(has_zero_component(along(0.0F, 1.0F, 1.0F)));
  EXPECT_FALSE(has_zero_component(along(0x1p-149F, 1.0F, 1.0F)));
}

TEST(StiffRays, AreSharesOfAllRays) {
  StiffRays counts;
  EXPECT_EQ(counts.stiff_pct(), 0.0);
  counts.add(std::array{along(1, 1, 1), along(0, 1, 0)});
  counts.add(std::array{along(1, 1, 1), along(1, 1, 0x1p-11F)});
  EXPECT_EQ(counts.stiff_pct(), 50.0);
  EXPECT_EQ(counts.zero_component_pct(), 25.0);
}

}  // namespace
}  // namespace hitpipe::ref::stiff_rays_test
