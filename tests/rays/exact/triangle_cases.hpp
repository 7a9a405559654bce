// Rays and triangles that are likely to break ray-triangle tests, by named category, and the definition of a
// hit in rational numbers.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "rays/mesh/mesh.hpp"
#include "rays/mesh/ray.hpp"
#include "sw_ref/judge/adversary/generators.hpp"
#include "sw_ref/judge/adversary/parts.hpp"
#include "tests/rays/exact/rational.hpp"

namespace hitpipe::ref::cases {

using adversary::nudged;
using adversary::Random;
using adversary::vector_of;
using oracle::exact;
using oracle::Rational;
using RationalVec = std::array<Rational, 3>;

inline RationalVec exact(const glm::vec3& v) {
  return {oracle::exact(v.x), oracle::exact(v.y), oracle::exact(v.z)};
}
inline RationalVec minus(const RationalVec& p, const RationalVec& q) {
  return {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
}
inline Rational dot(const RationalVec& p, const RationalVec& q) {
  return p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
}
inline RationalVec cross(const RationalVec& p, const RationalVec& q) {
  return {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
}

/// The definition: intersect the plane, then find the side of each edge on which the point lies.
inline std::optional<Rational> time_of_hit(const Mesh::Corners& corners, const Ray& ray) {
  const std::array corner{exact(corners.a), exact(corners.b), exact(corners.c)};
  const RationalVec normal = cross(minus(corner[1], corner[0]), minus(corner[2], corner[0]));
  const RationalVec origin = exact(ray.origin);
  const RationalVec direction = exact(ray.direction);
  const Rational slope = dot(normal, direction);
  if (slope == 0) return std::nullopt;
  const Rational t = dot(normal, minus(corner[0], origin)) / slope;
  if (t < 0 || (!ray.is_infinite() && t > oracle::exact(ray.length))) return std::nullopt;
  const RationalVec point{origin[0] + t * direction[0], origin[1] + t * direction[1],
                          origin[2] + t * direction[2]};
  for (std::size_t i = 0; i < 3; ++i) {
    const RationalVec edge = minus(corner[(i + 1) % 3], corner[i]);
    if (dot(cross(edge, minus(point, corner[i])), normal) < 0) return std::nullopt;
  }
  return t;
}

inline Mesh single(const Mesh::Corners& c) {
  Mesh mesh;
  mesh.vertices = {c.a, c.b, c.c};
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

struct Shot {
  Mesh::Corners corners;
  Ray ray;
};

inline std::string describe(const Shot& s) {
  std::string text = adversary::to_text(s.ray) + " corners";
  for (const glm::vec3& v : {s.corners.a, s.corners.b, s.corners.c}) {
    text += fmt::format(" {:a} {:a} {:a}", v.x, v.y, v.z);
  }
  return text;
}

inline glm::vec3 coarse_point(Random& random) {
  return vector_of([&] { return random.coarse(); });
}
inline glm::vec3 fine_point(Random& random) {
  return vector_of([&] { return random.signed_unit(); });
}

inline Mesh::Corners coarse_triangle(Random& random) {
  return {coarse_point(random), coarse_point(random), coarse_point(random)};
}

inline glm::vec3 nonzero(const glm::vec3& direction) {
  return direction == glm::vec3(0) ? glm::vec3(0, 0, 1) : direction;
}

inline Shot random_shot(Random& random) {
  const glm::vec3 a = fine_point(random);
  Shot s{{a, fine_point(random), fine_point(random)}, {}};
  s.ray.origin = fine_point(random);
  s.ray.direction = nonzero(vector_of([&] { return random.signed_unit(); }));
  return s;
}

/// Through a corner, a point of an edge or an inner point, exactly: a quarter of each side is a dyadic step.
inline Shot exact_shot(Random& random) {
  Shot s{coarse_triangle(random), {}};
  const auto weight = static_cast<float>(random.between(0, 4));
  const auto other = static_cast<float>(random.between(0, 4 - static_cast<int>(weight)));
  const glm::vec3 target =
      (s.corners.a * weight + s.corners.b * other + s.corners.c * (4.0F - weight - other)) * 0.25F;
  s.ray.origin = coarse_point(random);
  s.ray.direction = nonzero((target - s.ray.origin) * std::ldexp(1.0F, random.between(-3, 3)));
  return s;
}

inline Shot nudged_shot(Random& random) {
  Shot s = exact_shot(random);
  const int ulps = random.between(-2, 2);
  switch (random.below(3)) {
    case 0:
      s.corners.b[random.axis()] += static_cast<float>(ulps) * 0x1p-24F;
      break;
    case 1:
      s.ray.origin[random.axis()] += static_cast<float>(ulps) * 0x1p-24F;
      break;
    default: {
      float& component = s.ray.direction[random.axis()];
      component = nudged(component, ulps);
    }
  }
  return s;
}

inline Shot length_shot(Random& random) {
  Shot s = exact_shot(random);
  s.ray.direction = nonzero((s.corners.a + s.corners.b) * 0.5F - s.ray.origin);
  s.ray.length = nudged(1.0F, random.between(-1, 1));
  return s;
}

/// The plane lies just before or behind the end of the ray, closer than a double can resolve.
inline Shot length_within_a_hair(Random& random) {
  const int up = random.axis();
  Shot s{coarse_triangle(random), {}};
  const float height = random.sign() * static_cast<float>(random.between(1, 63)) * 0x1p-6F;
  for (glm::vec3* corner : {&s.corners.a, &s.corners.b, &s.corners.c}) {
    (*corner)[up] = height;
  }
  s.ray.origin = (s.corners.a + s.corners.b) * 0.25F + s.corners.c * 0.5F;
  const int speed = random.between(-20, 20);
  s.ray.origin[up] = random.sign() * std::ldexp(1.0F, -random.between(50, 149));
  s.ray.direction[up] = std::copysign(std::ldexp(1.0F, speed), height);
  s.ray.length = std::ldexp(std::abs(height), -speed);
  return s;
}

inline Shot origin_on_plane(Random& random) {
  Shot s = exact_shot(random);
  s.ray.origin = (s.corners.a + s.corners.b) * 0.5F + (s.corners.c - s.corners.a) * 0.25F;
  s.ray.direction = coarse_point(random);
  s.ray.direction = nonzero(s.ray.direction);
  if (random.coin()) s.ray.length = 0;
  if (random.coin()) s.ray.origin[random.axis()] += 0x1p-24F;
  return s;
}

inline Shot coplanar_shot(Random& random) {
  Shot s = exact_shot(random);
  s.ray.origin =
      s.corners.a + (s.corners.b - s.corners.a) * static_cast<float>(random.between(-1, 2)) * 0.25F;
  s.ray.direction = nonzero(s.corners.c - s.ray.origin);
  if (random.coin()) s.ray.direction = nonzero(s.corners.c - s.corners.b);
  return s;
}

inline Shot sliver_shot(Random& random) {
  Shot s = random_shot(random);
  s.corners.c = s.corners.a + (s.corners.b - s.corners.a) * 0.5F;
  s.corners.c[random.axis()] += std::ldexp(random.sign(), -random.between(15, 40));
  const float along = 0.5F + 0.5F * random.signed_unit();
  s.ray.direction = nonzero(s.corners.a + (s.corners.b - s.corners.a) * along - s.ray.origin);
  return s;
}

inline Shot extreme_direction(Random& random) {
  Shot s = exact_shot(random);
  if (random.coin()) {
    s.ray.direction *= std::ldexp(1.0F, random.between(100, 123));
  } else {
    s.ray.direction *= std::ldexp(1.0F, -random.between(100, 148));
    s.ray.direction = nonzero(s.ray.direction);
  }
  if (random.coin()) s.ray.length = std::ldexp(1.0F, random.between(-149, 127));
  return s;
}

inline Shot stiff_shot(Random& random) {
  Shot s{coarse_triangle(random), adversary::stiff(random).ray};
  const glm::vec3 target = s.corners.a;
  for (int axis = 0; axis < 3; ++axis) {
    if (random.coin()) s.ray.origin[axis] = target[axis];
  }
  return s;
}

inline Shot tiny_triangle(Random& random) {
  Shot s = exact_shot(random);
  const glm::vec3 step = s.corners.c - s.corners.a;
  s.corners.a = s.corners.b + step * 0x1p-20F;
  s.corners.c = s.corners.b + glm::vec3(step.y, step.z, -step.x) * 0x1p-20F;
  s.ray.direction =
      nonzero(s.corners.b + step * (0x1p-22F * static_cast<float>(random.between(-1, 4))) - s.ray.origin);
  return s;
}

inline Shot subnormal_triangle(Random& random) {
  Shot s = exact_shot(random);
  const float scale = 0x1p-143F;
  s.corners = {s.corners.a * scale, s.corners.b * scale, s.corners.c * scale};
  s.ray.origin *= random.coin() ? scale : 1.0F;
  s.ray.direction = nonzero(random.coin() ? s.corners.a - s.ray.origin : s.ray.direction);
  return s;
}

struct ShotCategory {
  const char* name;
  Shot (*make)(Random&);
};
inline constexpr std::array shot_categories{
    ShotCategory{"random", random_shot},
    ShotCategory{"through a corner, an edge or inside, exact", exact_shot},
    ShotCategory{"nudged from an exact aim", nudged_shot},
    ShotCategory{"length at the target and one ulp either side", length_shot},
    ShotCategory{"length a hair from the plane", length_within_a_hair},
    ShotCategory{"origin on the plane, or nearly", origin_on_plane},
    ShotCategory{"ray in the plane", coplanar_shot},
    ShotCategory{"sliver", sliver_shot},
    ShotCategory{"huge or subnormal direction", extreme_direction},
    ShotCategory{"stiff direction", stiff_shot},
    ShotCategory{"triangle of a millionth", tiny_triangle},
    ShotCategory{"subnormal triangle", subnormal_triangle},
};

}  // namespace hitpipe::ref::cases
