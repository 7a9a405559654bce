#include <array>

#include "sw_ref/judge/adversary/categories.hpp"
#include "sw_ref/judge/adversary/parts.hpp"

namespace hitpipe::ref::adversary {
namespace {

/// A ray along mostly one axis, before it has a box.
struct MajorAim {
  Ray ray;
  int major = 0;
  float along = 0;  ///< the ray is at its target when it has covered this many times its direction
};

/// n + g of some format: bits of an origin.
int origin_bits(Random& random) {
  return random.coin() ? std::array{6, 11, 14, 16, 20, 21, 22, 24}[random.below(8)] : random.between(6, 35);
}

/// An odd multiple of 2^-(g+1) is a tie of every grid that is finer by g bits. Next to 0 and to +-1 the box
/// grows to the plane's grid exactly, and a tie matters most.
float tie(Random& random) {
  const int finer = random.between(0, 3);
  const float half_step = std::ldexp(1.0F, -(finer + 1));
  switch (random.below(4)) {
    case 0:
      return random.sign() * half_step;
    case 1:
      return random.sign() * (1.0F - half_step);
    default:
      return random.sign() * static_cast<float>(2 * random.between(0, (1 << finer) - 1) + 1) * half_step;
  }
}

float lateral_origin(Random& random) {
  switch (random.below(4)) {
    case 0:
      return random.signed_zero();
    case 1:
      return tie(random);
    case 2:
      return random.coarse();
    default:
      return random.signed_unit();
  }
}

/// A ray from a coarse or extreme place along an axis, a quarter of the time to a place behind it. The other
/// components are still zero.
MajorAim along_major(Random& random) {
  MajorAim it;
  it.major = random.axis();
  it.ray.origin = vector_of([&] { return lateral_origin(random); });
  const float way = random.sign();
  it.ray.direction[it.major] = way;
  // Across the cube half of the time: there distances are largest.
  float& start = it.ray.origin[it.major];
  if (random.coin()) start = -way * nudged(1.0F, -random.between(0, 2));
  const float room = 1.0F + std::abs(start);
  it.along = random.coin()
                 ? room - std::ldexp(static_cast<float>(random.between(0, 8)), -random.between(5, 21))
                 : room * std::abs(random.signed_unit());
  if (random.below(4) == 0) it.along = -it.along;
  return it;
}

/// A mantissa at an end of its range, or anywhere in it.
float end_mantissa(Random& random) {
  switch (random.below(4)) {
    case 0:
      return 1.0F;
    case 1:
      return nudged(1.0F, random.between(1, 2));
    case 2:
      return nudged(2.0F, -random.between(1, 3));
    default:
      return 1.0F + std::abs(random.signed_unit());
  }
}

/// A box with faces where the ray is after `along`, to within an ulp, on the side that is chosen by chance.
Case box_at_target(Random& random, const MajorAim& from) {
  Case c{.ray = from.ray, .box = {}};
  for (int axis = 0; axis < 3; ++axis) {
    const double at = c.ray.origin[axis] + static_cast<double>(from.along) * c.ray.direction[axis];
    const float face =
        within_cube(nudged(static_cast<float>(at), random.below(4) == 0 ? random.between(-1, 1) : 0));
    const std::array extents{0.0F,
                             std::ldexp(static_cast<float>(random.between(1, 4)), -random.between(4, 24)),
                             std::abs(random.coarse())};
    const float extent = extents[random.below(3)];
    const bool below = random.coin();
    c.box.min[axis] = within_cube(below ? face - extent : face);
    c.box.max[axis] = within_cube(below ? face : face + extent);
  }
  // The size of a direction changes nothing but the length.
  const float scale = std::ldexp(1.0F, random.between(-60, 60));
  c.ray.direction *= scale;
  c.ray.length = length_about(random, std::max(from.along, 0.0F) / scale);
  return c;
}

Case fine_ties(Random& random) {
  MajorAim it = along_major(random);
  for (int axis = 0; axis < 3; ++axis) {
    if (axis == it.major && random.coin()) continue;
    it.ray.origin[axis] = nudged(tie(random), random.below(4) == 0 ? random.between(-1, 1) : 0);
    if (axis == it.major) continue;
    it.ray.direction[axis] = random.coin() ? random.signed_zero() : random.of_exponent(-40, -2);
  }
  return box_at_target(random, it);
}

Case equal_components(Random& random) {
  MajorAim it = along_major(random);
  if (random.coin()) it.ray.origin = vector_of([&] { return random.coarse(); });
  for (int axis = 0; axis < 3; ++axis) {
    if (axis == it.major) continue;
    it.ray.direction[axis] = random.sign();
    if (random.below(4) == 0) it.ray.direction[axis] *= nudged(1.0F, random.between(-2, 2));
    if (random.below(8) == 0) it.ray.direction[axis] = random.signed_zero();
  }
  it.along *= 0.5F;
  return box_at_target(random, it);
}

Case exponent_cap(Random& random) {
  MajorAim it = along_major(random);
  const int bits = origin_bits(random);
  for (int axis = 0; axis < 3; ++axis) {
    if (axis == it.major) continue;
    const int exponent = bits - 1 + random.between(-2, 2);
    it.ray.direction[axis] = random.sign() * std::ldexp(end_mantissa(random), -exponent);
    if (random.below(8) == 0) it.ray.direction[axis] = random.signed_zero();
  }
  return box_at_target(random, it);
}

Case mantissa_ends(Random& random) {
  MajorAim it = along_major(random);
  // |D_M| / |D_k| at a step of a p-bit mantissa, the last one before 2 half of the time, or an ulp beside it.
  const int steps = 1 << (random.between(4, 16) - 1);
  const int step = random.coin() ? steps - random.between(0, 1) : random.between(0, steps);
  const float major =
      nudged(1.0F + static_cast<float>(step) / static_cast<float>(steps), random.between(-1, 1));
  it.ray.direction[it.major] *= major;
  it.along /= major;
  for (int axis = 0; axis < 3; ++axis) {
    if (axis == it.major) continue;
    it.ray.direction[axis] = random.sign() * std::ldexp(1.0F, -random.between(1, 34));
    if (random.below(8) == 0) it.ray.direction[axis] = random.signed_zero();
  }
  return box_at_target(random, it);
}

/// A difference d of coordinates and a quotient 2^e with d 2^e about the largest word.
Case saturation(Random& random) {
  MajorAim it = along_major(random);
  const int bits = origin_bits(random);
  for (int axis = 0; axis < 3; ++axis) {
    if (axis == it.major) continue;
    const int exponent = random.between(0, bits - 1);
    it.ray.direction[axis] =
        random.sign() * std::ldexp(end_mantissa(random), -exponent - random.between(0, 1));
    if (std::abs(it.ray.direction[axis]) > 1.0F) it.ray.direction[axis] /= 2.0F;
    // Towards the inside, so that the far end of the ray is in the cube.
    const float reach = std::abs(it.along * it.ray.direction[axis]);
    float& start = it.ray.origin[axis];
    if (reach > 1.0F - std::abs(start)) start = std::copysign(std::max(0.0F, 1.0F - reach), start);
  }
  Case c = box_at_target(random, it);
  // One plane a few units of the grid beside the origin, where a difference changes its sign.
  if (random.below(4) == 0) {
    const int axis = (it.major + random.between(1, 2)) % 3;
    const float unit = std::ldexp(1.0F, -(bits - 2));
    const float beside =
        within_cube(c.ray.origin[axis] + static_cast<float>(random.between(-6, 6)) * 0.5F * unit);
    (random.coin() ? c.box.min : c.box.max)[axis] = beside;
    if (c.box.min[axis] > c.box.max[axis]) std::swap(c.box.min[axis], c.box.max[axis]);
  }
  return c;
}

}  // namespace

std::span<const Category> major_categories() {
  static constexpr Category table[] = {
      {"fine_ties",
       "origin halfway between two points of a fine grid, a face at the origin or on the ray's way",
       fine_ties},
      {"equal_components", "direction components that are equal, or within 2 ulps", equal_components},
      {"exponent_cap", "component ratios about 2^(n+g-1), the largest exponent, and zeros", exponent_cap},
      {"mantissa_ends", "component ratios at steps of a p-bit mantissa and just below 2", mantissa_ends},
      {"saturation", "differences that the shift just holds or saturates, on either side of the origin",
       saturation},
  };
  return table;
}

}  // namespace hitpipe::ref::adversary
