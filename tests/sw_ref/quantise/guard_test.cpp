// Every kind of violated demand is found and named in one line.
#include "sw_ref/quantise/guard.hpp"

#include <functional>
#include <limits>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/sw_ref/quantise/demand_scenes.hpp"

namespace hitpipe::ref::guard_test {
namespace {

using testing::HasSubstr;
using testing::Not;

/// The message; empty if nothing is thrown.
std::string said(const std::function<void()>& check) {
  try {
    check();
  } catch (const std::out_of_range& error) {
    EXPECT_THAT(error.what(), HasSubstr("outside the demands that the unit was fitted to: "));
    EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
    return error.what();
  }
  return {};
}

SceneDemands demands_by_view(const Scene& scene) {
  return scene_demands(scene, build_bvh(scene.mesh), {64, 48});
}

class GuardOfStairs : public testing::Test {
 protected:
  [[nodiscard]] std::string ray(RayKind kind, const Ray& ray) const {
    return said([&] { check_ray_against(demands_, kind, ray); });
  }

  Scene scene_ = stairs_along_one_class();
  SceneDemands demands_ = demands_by_view(scene_);
  Ray good_{scene_.camera.eye, glm::vec3(scene_.camera.forward), Ray::infinite};
};

TEST_F(GuardOfStairs, TakesWhatIsDemanded) {
  EXPECT_EQ(ray(RayKind::primary, good_), "");
}

TEST_F(GuardOfStairs, SeesAKindOfRayThatWasNotToCome) {
  EXPECT_THAT(ray(RayKind::secondary, good_), HasSubstr("secondary rays; the demands allow none"));
  demands_.rays.pop_back();
  EXPECT_THAT(ray(RayKind::shadow, good_), HasSubstr("shadow rays; the demands allow none"));
}

TEST_F(GuardOfStairs, SeesAnOriginOutside) {
  Ray moved = good_;
  moved.origin.y = std::nextafter(moved.origin.y, 1.0F);
  EXPECT_THAT(ray(RayKind::primary, moved), HasSubstr("primary ray with origin.y = "));
  moved.origin.y = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(ray(RayKind::primary, moved), HasSubstr("origin.y = nan"));
}

TEST_F(GuardOfStairs, SeesAnotherDirectionClassAndAZero) {
  for (int axis = 0; axis < 3; ++axis) {
    Ray turned = good_;
    turned.direction[axis] = -turned.direction[axis];
    EXPECT_THAT(ray(RayKind::primary, turned), HasSubstr("primary ray with direction.")) << axis;
    turned.direction[axis] = 0.0F;
    EXPECT_THAT(ray(RayKind::primary, turned), HasSubstr(" = 0, demanded is ")) << axis;
  }
}

TEST_F(GuardOfStairs, SeesAnEndThatIsMissingOrNotWanted) {
  demands_.infinite = false;
  EXPECT_THAT(ray(RayKind::primary, good_), HasSubstr("a ray without an end"));
  demands_.infinite = true;
  demands_.finite = false;
  good_.length = 1.0F;
  EXPECT_THAT(ray(RayKind::primary, good_), HasSubstr("a ray with an end"));
}

}  // namespace
}  // namespace hitpipe::ref::guard_test
