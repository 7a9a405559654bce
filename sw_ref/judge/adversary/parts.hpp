// Building blocks of the generators: boxes, points on them, and rays through points. "Exactly" holds for
// coarse coordinates, which are multiples of 2^-6: their differences are exact, and so is a direction made
// from them.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "sw_ref/judge/adversary/case.hpp"
#include "sw_ref/judge/adversary/random.hpp"

namespace hitpipe::ref::adversary {

/// The binary32 value `ulps` steps above a finite x; both zeros count as one value.
inline float nudged(float x, int ulps) {
  if (ulps == 0) return x;
  const auto magnitude = static_cast<std::int32_t>(std::bit_cast<std::uint32_t>(x) & 0x7FFFFFFFU);
  const std::int32_t order = (std::signbit(x) ? -magnitude : magnitude) + ulps;
  constexpr std::int32_t infinity = 0x7F800000;
  const auto size = static_cast<std::uint32_t>(std::min(std::abs(order), infinity));
  return std::bit_cast<float>(order < 0 ? size | 0x80000000U : size);
}

inline float within_cube(float x) {
  return std::clamp(x, -1.0F, 1.0F);
}

template <class Coordinate>
glm::vec3 vector_of(Coordinate coordinate) {
  glm::vec3 v;
  for (int axis = 0; axis < 3; ++axis) v[axis] = coordinate();
  return v;
}

template <class Coordinate>
Aabb box_of(Coordinate coordinate) {
  Aabb box;
  box.grow(vector_of(coordinate));
  box.grow(vector_of(coordinate));
  return box;
}

inline Aabb coarse_box(Random& random) {
  return box_of([&] { return random.coarse(); });
}

/// A box of any size from the whole cube down to 2^-20 of it, for each axis separately.
inline Aabb sized_box(Random& random) {
  Aabb box;
  for (int axis = 0; axis < 3; ++axis) {
    const float middle = random.signed_unit();
    const float half = std::ldexp(std::abs(random.signed_unit()), -random.between(0, 20));
    box.min[axis] = within_cube(middle - half);
    box.max[axis] = within_cube(middle + half);
  }
  return box;
}

/// A point of the box that lies on a face on `fixed` axes, and at a quarter of the extent on the others. It
/// is exact for a coarse box.
inline glm::vec3 point_of(Random& random, const Aabb& box, int fixed) {
  glm::vec3 point;
  const int first = random.axis();
  for (int i = 0; i < 3; ++i) {
    const int axis = (first + i) % 3;
    const float low = box.min[axis];
    const float high = box.max[axis];
    const auto quarter = static_cast<float>(random.between(1, 3));
    point[axis] = i >= fixed ? low + (high - low) * (quarter / 4) : random.coin() ? low : high;
  }
  return point;
}

/// Replaces a zero direction, which is not allowed, by an axis.
inline void give_direction(Random& random, Ray& ray) {
  if (ray.direction == glm::vec3(0)) ray.direction[random.axis()] = random.sign();
}

/// Turns the ray towards the target. The ray reaches it at the returned t = 2^-k, exactly if origin and
/// target are coarse.
inline float aim(Random& random, Ray& ray, const glm::vec3& target) {
  const int k = random.between(-8, 8);
  for (int axis = 0; axis < 3; ++axis) {
    ray.direction[axis] = std::ldexp(target[axis] - ray.origin[axis], k);
  }
  give_direction(random, ray);
  return std::ldexp(1.0F, -k);
}

/// A length for a ray to a target: infinite, ending at the target or an ulp from it, or beyond it.
inline float length_about(Random& random, float target) {
  switch (random.below(4)) {
    case 0:
      return nudged(target, target > 0 ? random.between(-1, 1) : random.between(0, 1));
    case 1:
      return 1.5F * target;
    default:
      return Ray::infinite;
  }
}

/// Moves a component of the direction, or a coordinate of the origin, by up to 4 ulps.
inline void disturb(Random& random, Ray& ray) {
  const int axis = random.axis();
  const int ulps = random.between(-4, 4);
  if (random.coin()) {
    ray.direction[axis] = nudged(ray.direction[axis], ulps);
    give_direction(random, ray);
  } else {
    ray.origin[axis] = within_cube(nudged(ray.origin[axis], ulps));
  }
}

/// A ray from anywhere through a point with `fixed` coordinates on faces of the box, either exactly or
/// nearly.
inline Case aimed_at(Random& random, const Aabb& box, int fixed) {
  Case c{.ray = {}, .box = box};
  c.ray.origin = vector_of([&] { return random.coarse(); });
  const float t = aim(random, c.ray, point_of(random, box, fixed));
  c.ray.length = length_about(random, t);
  if (random.coin()) disturb(random, c.ray);
  return c;
}

}  // namespace hitpipe::ref::adversary
