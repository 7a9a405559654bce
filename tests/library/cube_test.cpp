// Rays and boxes moved into the cube, against rational arithmetic.
#include <cmath>

#include <boost/multiprecision/cpp_int.hpp>
#include <gtest/gtest.h>
#include <hitpipe/ref.hpp>

#include "sw_ref/judge/adversary/random.hpp"
#include "tests/message_of.hpp"

namespace hitpipe {
namespace {

using Rational = boost::multiprecision::cpp_rational;

Rational moved(double own, double offset, double scale) {
  return (Rational(own) - Rational(offset)) * Rational(scale);
}

TEST(LibraryCube, TheLongestSideOfTheBoundsFillsTheCube) {
  const Transform t = fit({{-10, 0, 4}, {30, 10, 6}});
  EXPECT_EQ(t.offset[0], 10);
  EXPECT_EQ(t.offset[1], 5);
  EXPECT_EQ(t.offset[2], 5);
  EXPECT_EQ(t.scale, (1 - 0x1p-10) / 20);
}

TEST(LibraryCube, AMovedBoxHoldsTheExactOneAndIsTheLeastThatDoes) {
  ref::adversary::Random random(1);
  const auto draw = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random.bits() >> 11) * 0x1p-53;
  };
  std::size_t tests = 0;
  for (int scene = 0; scene < 50; ++scene) {
    const double size = std::ldexp(draw(1, 2), static_cast<int>(random.between(-40, 40)));
    const double far = size * std::ldexp(1.0, static_cast<int>(random.between(-5, 20)));
    Bounds bounds;
    for (int axis = 0; axis < 3; ++axis) {
      bounds.min[axis] = draw(-far, far);
      bounds.max[axis] = bounds.min[axis] + draw(0.5, 1) * size;
    }
    const Transform t = fit(bounds);
    for (int i = 0; i < 40; ++i) {
      Bounds own;
      for (int axis = 0; axis < 3; ++axis) {
        own.min[axis] = draw(bounds.min[axis], bounds.max[axis]);
        own.max[axis] = draw(own.min[axis], bounds.max[axis]);
      }
      const Box box = to_cube(t, own);
      for (int axis = 0; axis < 3; ++axis) {
        const Rational low = moved(own.min[axis], t.offset[axis], t.scale);
        const Rational high = moved(own.max[axis], t.offset[axis], t.scale);
        ASSERT_LE(Rational(box.min[axis]), low);
        ASSERT_GT(Rational(std::nextafter(box.min[axis], 2.0F)), low);
        ASSERT_GE(Rational(box.max[axis]), high);
        ASSERT_LT(Rational(std::nextafter(box.max[axis], -2.0F)), high);
        ++tests;
      }
    }
  }
  EXPECT_EQ(tests, 50 * 40 * 3U);
}

TEST(LibraryCube, WhatADoubleRoundsOffMovesAPlaneOutward) {
  const float below = std::nextafter(0.5F, 0.0F);
  const float above = std::nextafter(0.5F, 1.0F);
  // 0.5 -+ 2^-80: the difference is rounded to 0.5.
  const Box by_offset = to_cube({{0x1p-80, -0x1p-80, 0}, 1}, {{0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}});
  EXPECT_EQ(by_offset.min[0], below);
  EXPECT_EQ(by_offset.max[0], 0.5F);
  EXPECT_EQ(by_offset.min[1], 0.5F);
  EXPECT_EQ(by_offset.max[1], above);
  EXPECT_EQ(by_offset.min[2], 0.5F);
  EXPECT_EQ(by_offset.max[2], 0.5F);
  // 0.5 (1 + 2^-30) (1 - 2^-30): the product is rounded to 0.5.
  const double own = 0.5 + 0x1p-31;
  const Box by_scale = to_cube({{0, 0, 0}, 1 - 0x1p-30}, {{own, -own, 0}, {own, -own, 0}});
  EXPECT_EQ(by_scale.min[0], below);
  EXPECT_EQ(by_scale.max[0], 0.5F);
  EXPECT_EQ(by_scale.min[1], -0.5F);
  EXPECT_EQ(by_scale.max[1], -below);
}

TEST(LibraryCube, BinaryThirtyTwoIsNotMovedWithoutATransform) {
  const Box box = rounded_outward({{-1, 0.1, 0x1p-149}, {0.25, 0.1, 1}});
  EXPECT_EQ(box.min[0], -1.0F);
  EXPECT_EQ(box.max[0], 0.25F);
  EXPECT_LT(box.min[1], 0.1);
  EXPECT_GT(box.max[1], 0.1);
  EXPECT_EQ(std::nextafter(box.min[1], 1.0F), box.max[1]);
  EXPECT_EQ(box.min[2], 0x1p-149F);
}

TEST(LibraryCube, ARayKeepsItsDirectionAndScalesItsLength) {
  const Transform t{{10, 0, 0}, 0.125};
  const double origin[] = {12, 4, -4};
  const double direction[] = {3, -4, 0};
  const Ray ray = to_cube(t, origin, direction, 2);
  EXPECT_EQ(ray.origin[0], 0.25F);
  EXPECT_EQ(ray.origin[1], 0.5F);
  EXPECT_EQ(ray.origin[2], -0.5F);
  EXPECT_EQ(ray.direction[0], 3.0F);
  EXPECT_EQ(ray.direction[1], -4.0F);
  EXPECT_EQ(ray.length, 0.25F);
  EXPECT_EQ(to_cube(t, origin, direction).length, endless);
}

TEST(LibraryCube, RefusesWhatDoesNotFit) {
  const Transform t{{0, 0, 0}, 1};
  const double origin[] = {0, 0, 0};
  const double direction[] = {1, 0, 0};
  const double outside[] = {0, 3, 0};
  const double nowhere[] = {0, 1e-60, 0};
  EXPECT_EQ(message_of<Error>([&] {
              static_cast<void>(to_cube(t, Bounds{{0, 0, 0}, {0, 0, 1.5}}));
            }),
            "box 0: max.z = 1.5 is outside the cube; allowed is [-1, 1]");
  EXPECT_EQ(message_of<Error>([&] {
              static_cast<void>(to_cube(t, Bounds{{0, 1, 0}, {0, 0.5, 1}}));
            }),
            "box: y from 1 to 0.5; it must be finite and from low to high");
  EXPECT_EQ(message_of<Error>([&] { static_cast<void>(to_cube(t, outside, direction)); }),
            "ray: origin.y = 3 is outside the cube; allowed is [-1, 1]");
  EXPECT_EQ(message_of<Error>([&] { static_cast<void>(to_cube(t, origin, nowhere)); }),
            "ray: direction is (0, 0, 0); one component must differ from 0");
  EXPECT_EQ(message_of<Error>([&] { static_cast<void>(to_cube(t, origin, direction, 1e60)); }),
            "ray: length = 1e+60 is beyond binary32; for a ray without an end pass INFINITY");
  EXPECT_EQ(message_of<Error>([&] {
              static_cast<void>(to_cube(Transform{{0, 0, 0}, 0}, origin, direction));
            }),
            "transform: offset (0, 0, 0), scale 0; they must be finite, and the scale > 0");
  EXPECT_EQ(message_of<Error>([] {
              static_cast<void>(fit({{0, 0, 0}, {0, 0, 0}}));
            }),
            "bounds: the longest side is 0; no scale takes that into the cube");
  EXPECT_EQ(message_of<Error>([] {
              static_cast<void>(fit({{0, 0, 0}, {INFINITY, 0, 0}}));
            }),
            "bounds: x from 0 to inf; it must be finite and from low to high");
}

}  // namespace
}  // namespace hitpipe
