// Where a ray may begin, asked without moving it, is where the moved ray begins in the cube.
#include "rays/world/to_cube.hpp"

#include <cmath>
#include <limits>
#include <random>

#include <glm/common.hpp>
#include <gtest/gtest.h>

namespace hitpipe::ref::to_cube_test {
namespace {

constexpr float limit = 0x1p24F;

/// As it was asked before there were Origins: of the moved ray.
bool begins_inside(const glm::vec3& origin, const Normalisation& transform) {
  const glm::vec3 moved = ray_to_cube(glm::dvec3(origin), {1, 0, 0}, 1, transform).origin;
  for (int axis = 0; axis < 3; ++axis)
    if (!(std::abs(origin[axis]) <= limit && std::abs(moved[axis]) <= 1.0F)) return false;
  return true;
}

TEST(Origins, AreThoseThatTheCubeHolds) {
  std::mt19937 random(1);
  const auto number = [&](double most) {
    return std::uniform_real_distribution<double>(-most, most)(random);
  };
  int inside = 0, outside = 0;
  for (int cube = 0; cube < 2000; ++cube) {
    const double size = std::exp2(number(40));
    const Normalisation transform{.offset = {number(4 * size), number(4 * size), number(4 * size)},
                                  .scale = 1 / size};
    const Origins origins = origins_in_cube(transform, limit);
    for (int ray = 0; ray < 60; ++ray) {
      glm::vec3 origin(transform.to_own({number(0.9), number(0.9), number(0.9)}));
      const int axis = ray % 3;
      // Beside a face of the cube or of what is allowed, a few binary32s to either side of it.
      glm::dvec3 face(transform.to_own(glm::dvec3(ray % 2 == 0 ? 1.0 : -1.0)));
      if (ray % 4 >= 2) face = glm::clamp(face, -double{limit}, double{limit});
      origin[axis] = static_cast<float>(face[axis]);
      for (auto steps = random() % 4; steps > 0; --steps)
        origin[axis] = std::nextafter(origin[axis],
                                      (random() % 2 == 0 ? 1 : -1) * std::numeric_limits<float>::infinity());
      const bool is_inside = begins_inside(origin, transform);
      ASSERT_EQ(origins.hold(origin), is_inside)
          << origin[axis] << " of a cube at " << transform.offset[axis] << " +- " << size;
      ++(is_inside ? inside : outside);
    }
  }
  EXPECT_GT(inside, 20000);
  EXPECT_GT(outside, 20000);
}

TEST(Origins, OfACubeBetweenTwoBinary32sAreNone) {
  const Origins origins = origins_in_cube({.offset = {1 + 0x1p-25, 0, 0}, .scale = 0x1p60}, limit);
  EXPECT_GT(origins.least.x, origins.most.x);
  EXPECT_FALSE(origins.hold({1.0F, 0, 0}));
  EXPECT_FALSE(origins.hold({std::numeric_limits<float>::quiet_NaN(), 0, 0}));
}

}  // namespace
}  // namespace hitpipe::ref::to_cube_test
