// The door against rational arithmetic, for every format.
#include "rays/world/int_ray.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "rays/exact/grid.hpp"
#include "tests/rays/exact/rational.hpp"
#include "tests/rays/world/cases.hpp"

namespace hitpipe::ref::int_ray_test {
namespace {

using hls::MajorBits;
using hls::WorldBits;
using oracle::exact;
using oracle::Integer;
using oracle::Rational;
using world_cases::Draw;

Rational power_of_two(int exponent) {
  const Rational power = Integer(1) << static_cast<unsigned>(std::abs(exponent));
  return exponent < 0 ? Rational(1) / power : power;
}
Integer nearest(const Rational& x) {
  return oracle::floor(Rational(x + Rational(1, 2)));
}

/// Round numbers give ties; powers of two give slopes near 0.
float component(Draw& draw, float most) {
  const auto sixteenths = static_cast<float>(draw.integer(-16, 16)) / 16.0F * most;
  if (draw.one_in(3)) return sixteenths;
  const auto any = static_cast<float>(draw.integer(-1'000'000, 1'000'000)) * 1e-6F * most;
  return draw.one_in(3) ? std::ldexp(any, -static_cast<int>(draw.integer(0, 60))) : any;
}

TEST(IntRay, IsRoundedExactly) {
  Draw draw(39011);
  for (int i = 0; i < 20'000; ++i) {
    const WorldBits bits = draw.bits();
    Ray ray;
    const float scale = draw.one_in(4) ? std::ldexp(1.0F, static_cast<int>(draw.integer(-120, 120))) : 1.0F;
    for (int axis = 0; axis < 3; ++axis) {
      ray.origin[axis] = component(draw, 1.0F);
      ray.direction[axis] = component(draw, 1.0F) * scale;
    }
    if (ray.direction == glm::vec3(0.0F)) continue;
    if (draw.one_in(2)) ray.length = std::abs(component(draw, 4.0F)) / scale;
    if (!std::isfinite(ray.length)) ray.length = Ray::infinite;
    const IntRay made = int_ray(ray, bits);

    const Rational grid = Rational(Integer(bits.largest_point()));
    Rational major = 0;
    for (int axis = 2; axis >= 0; --axis) {
      const Rational size = exact(std::abs(ray.direction[axis]));
      if (size >= major) major = size;
    }
    int axis_of_major = 0;
    while (exact(std::abs(ray.direction[axis_of_major])) != major) ++axis_of_major;
    ASSERT_EQ(made.major, axis_of_major);
    for (int axis = 0; axis < 3; ++axis) {
      const auto k = static_cast<std::size_t>(axis);
      ASSERT_EQ(Integer(made.origin[k]), nearest(Rational(grid * exact(ray.origin[axis]))));
      const Integer slope =
          nearest(Rational(power_of_two(bits.slope) * exact(std::abs(ray.direction[axis])) / major));
      ASSERT_EQ(Integer(std::abs(made.direction[k])), slope);
      ASSERT_EQ(made.direction[k] < 0, ray.direction[axis] < 0 && slope != 0);
      ASSERT_EQ(made.negative[k], ray.direction[axis] < 0);
    }
    Integer length = bits.largest_distance();
    if (!ray.is_infinite())
      length = std::min(
          length, oracle::floor(Rational(exact(ray.length) * major * grid * power_of_two(bits.fraction))));
    ASSERT_EQ(Integer(made.length), length);
  }
}

TEST(IntRay, MantissasBoundTheInverseSlope) {
  Draw draw(39012);
  for (int i = 0; i < 20'000; ++i) {
    const WorldBits world{static_cast<int>(draw.integer(6, 24)), static_cast<int>(draw.integer(0, 3)),
                          static_cast<int>(draw.integer(8, 32)), 0};
    const MajorBits bits{world.coord, world.finer, static_cast<int>(draw.integer(3, 13)), 0, world.slope};
    if (!bits.proved()) continue;
    IntRay ray = draw.ray(world, draw.triangle(world));
    const auto major = static_cast<std::size_t>(ray.major);
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (axis != major && draw.one_in(4))
        ray.direction[axis] = std::int64_t{1} << draw.integer(0, world.slope);
    const IntMajorRay made = major_ray(ray, bits);
    ASSERT_EQ(made.axes[0], ray.major);
    for (std::size_t ray_axis = 0; ray_axis < 3; ++ray_axis) {
      const auto axis = static_cast<std::size_t>(made.axes[ray_axis]);
      ASSERT_EQ(made.origin[ray_axis], ray.negative[axis] ? ray.origin[axis] + 1 : -ray.origin[axis]);
      if (ray_axis == 0) continue;
      const MajorQuotient& q = made.quotient[ray_axis - 1];
      const std::int64_t slope = std::abs(ray.direction[axis]);
      const std::int64_t half = std::int64_t{1} << (bits.mantissa - 1);
      if (slope == 0) {
        ASSERT_EQ(q, (MajorQuotient{static_cast<std::uint32_t>(half), static_cast<std::uint32_t>(half),
                                    bits.largest_exponent()}));
        continue;
      }
      const Rational inverse = power_of_two(world.slope + bits.mantissa - 1 - q.exponent) / Integer(slope);
      if (q.mantissa_low == q.mantissa_high && Rational(Integer(q.mantissa_low)) != inverse) {
        ASSERT_EQ(q, largest_quotient(bits));
        ASSERT_GT(inverse, Rational(Integer(q.mantissa_high)));
        continue;
      }
      ASSERT_EQ(Integer(q.mantissa_low), oracle::floor(inverse));
      ASSERT_EQ(Integer(q.mantissa_high), oracle::ceil(inverse));
      ASSERT_GE(q.mantissa_high, half);
    }
  }
}

TEST(IntRay, RefusesWhatIsNoRay) {
  const WorldBits bits;
  const Ray good{{0, 0, 0}, {1, 0, 0}, 1.0F};
  EXPECT_NO_THROW((void)int_ray(good, bits));
  Ray bad = good;
  bad.origin.x = 1.5F;
  EXPECT_THROW((void)int_ray(bad, bits), std::out_of_range);
  bad = good;
  bad.direction = glm::vec3(0.0F);
  EXPECT_THROW((void)int_ray(bad, bits), std::invalid_argument);
  bad = good;
  bad.length = -1.0F;
  EXPECT_THROW((void)int_ray(bad, bits), std::invalid_argument);
  EXPECT_THROW((void)int_ray(good, WorldBits{25, 1, 20, 0}), std::invalid_argument);
}

}  // namespace
}  // namespace hitpipe::ref::int_ray_test
