// Rays and boxes that are likely to break ray-box tests, by named category. The tests of the exact referee
// and of the integer quantisation share them. "Exactly aimed" cases use coarse coordinates, so that the ray
// passes through its target exactly.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include "sw_ref/judge/adversary/case.hpp"
#include "sw_ref/judge/adversary/parts.hpp"
#include "sw_ref/judge/adversary/random.hpp"

namespace hitpipe::ref::cases {

/// Every scene lies within +-(1 - 2^-10) before its boxes are padded by 5e-7 (section 4.3).
inline constexpr float scene_limit = 1.0F - 0x1p-10F;
inline constexpr float padding = 5e-7F;

using adversary::Case;
using adversary::nudged;
using adversary::vector_of;

class Random : public adversary::Random {
 public:
  using adversary::Random::Random;

  std::size_t axis() { return below(3); }
  float coordinate() { return signed_unit() * scene_limit; }
  /// A number of nearly any exponent.
  float any_finite() { return of_exponent(-150, 127); }
};

inline float& at(glm::vec3& v, std::size_t axis) {
  return v[static_cast<int>(axis)];
}
inline float at(const glm::vec3& v, std::size_t axis) {
  return v[static_cast<int>(axis)];
}

inline Aabb coarse_box(Random& random) {
  Aabb box;
  box.grow(vector_of([&] { return random.coarse(); }));
  box.grow(vector_of([&] { return random.coarse(); }));
  return box;
}

/// Aims an infinite ray at a corner, edge, face or inner point of a coarse box. It gets there at exactly t =
/// 2^-k. Returns k.
inline int aim(Random& random, Case& c) {
  const int k = random.between(-8, 8);
  c.ray.origin = vector_of([&] { return random.coarse(); });
  do {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float low = at(c.box.min, axis);
      const float high = at(c.box.max, axis);
      const float target = std::array{low, high, (low + high) / 2}[random.below(3)];
      at(c.ray.direction, axis) = std::ldexp(target - at(c.ray.origin, axis), k);
    }
    if (c.ray.direction == glm::vec3(0)) c.ray.origin = vector_of([&] { return random.coarse(); });
  } while (c.ray.direction == glm::vec3(0));
  return k;
}

inline Case random_case(Random& random) {
  Case c;
  c.box.grow(vector_of([&] { return random.coordinate(); }));
  c.box.grow(vector_of([&] { return random.coordinate(); }));
  c.ray.origin = vector_of([&] { return random.coordinate(); });
  c.ray.direction = vector_of([&] { return random.signed_unit(); });
  if (random.coin()) c.ray.length = std::ldexp(1.0F + random.signed_unit(), random.between(-3, 1));
  return c;
}

inline Case rounded_aim(Random& random) {
  Case c = random_case(random);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float low = at(c.box.min, axis);
    const float high = at(c.box.max, axis);
    const float target = std::array{low, high, std::lerp(low, high, 0.37F)}[random.below(3)];
    at(c.ray.direction, axis) = target - at(c.ray.origin, axis);
  }
  c.ray.length = random.coin() ? Ray::infinite : nudged(1.0F, random.between(-2, 2));
  return c;
}

inline Case exact_aim(Random& random) {
  Case c{.ray = {}, .box = coarse_box(random)};
  aim(random, c);
  return c;
}

inline Case near_aim(Random& random) {
  Case c = exact_aim(random);
  const std::size_t axis = random.axis();
  const int ulps = random.between(-3, 3);
  switch (random.below(3)) {
    case 0:
      at(c.ray.direction, axis) = nudged(at(c.ray.direction, axis), ulps);
      break;
    case 1:
      at(c.ray.origin, axis) = nudged(at(c.ray.origin, axis), ulps);
      break;
    default: {
      c.box.min = c.box.max = glm::vec3(nudged(c.box.min.x, std::abs(ulps)), c.box.min.y, c.box.min.z);
      const glm::vec3 corner = vector_of([&] { return random.coarse(); });
      c.box.grow(corner);
      aim(random, c);
    }
  }
  if (c.ray.direction == glm::vec3(0)) c.ray.direction.x = 1;
  return c;
}

inline float signed_zero(Random& random) {
  return random.coin() ? 0.0F : -0.0F;
}

inline Case axis_parallel(Random& random) {
  Case c = exact_aim(random);
  const std::size_t moving = random.axis();
  const bool two_zeros = random.coin();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (axis == moving) {
      if (at(c.ray.direction, axis) == 0) at(c.ray.direction, axis) = random.sign();
    } else if (two_zeros || axis == (moving + 1) % 3) {
      at(c.ray.direction, axis) = signed_zero(random);
    }
  }
  return c;
}

inline Case in_face_plane(Random& random) {
  Case c = axis_parallel(random);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (at(c.ray.direction, axis) != 0) continue;
    at(c.ray.origin, axis) =
        nudged(random.coin() ? at(c.box.min, axis) : at(c.box.max, axis), random.between(-1, 1));
  }
  return c;
}

inline Case flat_box(Random& random) {
  Case c{.ray = {}, .box = coarse_box(random)};
  for (std::size_t axis = 0, flat = random.below(8); axis < 3; ++axis) {
    if ((flat >> axis & 1U) != 0 || axis == 0) at(c.box.max, axis) = at(c.box.min, axis);
  }
  aim(random, c);
  if (random.coin()) at(c.ray.direction, random.axis()) += 0x1p-20F;
  if (c.ray.direction == glm::vec3(0)) c.ray.direction.x = 1;
  return c;
}

inline Case origin_at_box(Random& random) {
  Case c{.ray = {}, .box = coarse_box(random)};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float low = at(c.box.min, axis);
    const float high = at(c.box.max, axis);
    at(c.ray.origin, axis) =
        nudged(std::array{low, high, (low + high) / 2}[random.below(3)], random.between(-1, 1));
    at(c.ray.direction, axis) = random.below(4) == 0 ? signed_zero(random) : random.signed_unit();
  }
  if (c.ray.direction == glm::vec3(0)) c.ray.direction.y = -1;
  if (random.coin()) c.ray.length = 0;
  return c;
}

inline Case box_behind(Random& random) {
  Case c = exact_aim(random);
  c.ray.direction = -c.ray.direction;
  return c;
}

/// The ray ends exactly on its target, or one step before or behind it.
inline Case length_at_target(Random& random) {
  Case c{.ray = {}, .box = coarse_box(random)};
  const int k = aim(random, c);
  c.ray.length = nudged(std::ldexp(1.0F, -k), random.between(-1, 1));
  return c;
}

inline Case subnormal(Random& random) {
  Case c = exact_aim(random);
  const auto tiny = [&] { return random.sign() * std::ldexp(1.0F, random.between(-149, -126)); };
  switch (random.below(3)) {
    case 0:
      c.ray.direction = vector_of(tiny);
      break;
    case 1:
      at(c.ray.direction, random.axis()) = tiny();
      break;
    default: {
      const std::size_t axis = random.axis();
      at(c.box.min, axis) = -std::abs(tiny());
      at(c.box.max, axis) = random.coin() ? std::abs(tiny()) : 0.0F;
      at(c.ray.origin, axis) = tiny();
    }
  }
  if (c.ray.direction == glm::vec3(0)) c.ray.direction = vector_of(tiny);
  if (random.coin()) c.ray.length = std::ldexp(1.0F, random.between(0, 127));
  return c;
}

/// Components that differ by up to 2^149 and more, mostly within the box on the slow axes.
inline Case stiff(Random& random) {
  Case c{.ray = {}, .box = coarse_box(random)};
  aim(random, c);
  const std::size_t fast = random.axis();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (axis == fast) continue;
    const float low = at(c.box.min, axis);
    const float high = at(c.box.max, axis);
    at(c.ray.origin, axis) = std::array{low, high, (low + high) / 2, random.coarse()}[random.below(4)];
    at(c.ray.direction, axis) = random.sign() * std::ldexp(1.5F, -random.between(0, 150));
  }
  at(c.ray.direction, fast) = random.sign() * std::ldexp(1.25F, random.between(-20, 126));
  if (random.coin()) c.ray.length = std::ldexp(1.0F, random.between(-127, 127));
  return c;
}

inline Case signed_zeros(Random& random) {
  Case c = rounded_aim(random);
  at(c.ray.direction, random.axis()) = signed_zero(random);
  at(c.ray.direction, random.axis()) = signed_zero(random);
  return c;
}

/// Boxes and origins on the border of the cube, padded or not.
inline Case at_cube_border(Random& random) {
  Case c = rounded_aim(random);
  const std::size_t axis = random.axis();
  const float pad = random.coin() ? padding : 0.0F;
  if (random.coin()) at(c.box.max, axis) = scene_limit + pad;
  if (random.coin()) at(c.box.min, axis) = -scene_limit - pad;
  if (random.coin()) at(c.ray.origin, axis) = random.sign();
  if (random.coin()) at(c.ray.direction, axis) = at(c.box.max, axis) - at(c.ray.origin, axis);
  return c;
}

inline Case huge_direction(Random& random) {
  Case c = exact_aim(random);
  c.ray.direction *= 0x1p118F;
  c.ray.length = random.coin() ? Ray::infinite : std::ldexp(1.0F, -random.between(100, 149));
  return c;
}

struct Category {
  const char* name;
  Case (*make)(Random&);
};

inline constexpr std::array categories{
    Category{"random", random_case},
    Category{"aimed at corner, edge, face or inside, direction rounded", rounded_aim},
    Category{"aimed at corner, edge, face or inside, exact", exact_aim},
    Category{"within 3 ulps of an exact aim", near_aim},
    Category{"parallel to an axis or a face", axis_parallel},
    Category{"in the plane of a face", in_face_plane},
    Category{"flat, line or point box", flat_box},
    Category{"origin on or in the box", origin_at_box},
    Category{"box behind the origin", box_behind},
    Category{"length at the target and one ulp either side", length_at_target},
    Category{"subnormal direction, origin or box", subnormal},
    Category{"stiff direction", stiff},
    Category{"signed zeros", signed_zeros},
    Category{"border of the cube, padded and not", at_cube_border},
    Category{"huge direction", huge_direction},
};

/// The inputs in hex, to be pasted into a test.
inline std::string describe(const Ray& ray) {
  return adversary::to_text(ray);
}
inline std::string describe(const Case& c) {
  return adversary::to_text(c);
}

}  // namespace hitpipe::ref::cases
