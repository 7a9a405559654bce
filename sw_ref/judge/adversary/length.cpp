// Cases by the end of the ray: at the box, at the origin, or out of range.
#include <limits>

#include "sw_ref/judge/adversary/generators.hpp"
#include "sw_ref/judge/adversary/parts.hpp"

namespace hitpipe::ref::adversary {
namespace {

/// A ray that crosses the box's near or far plane on one axis, inside the face, and ends there within an ulp.
/// If it is not turned the end is exact, because the plane is coarse and the ray reaches it at a power of
/// two.
Case ending_at_plane(Random& random, bool entry) {
  Case c{.ray = {}, .box = coarse_box(random)};
  c.ray.origin = vector_of([&] { return random.coarse(); });
  const int axis = random.axis();
  const bool forward = random.coin();
  float& low = c.box.min[axis];
  float& high = c.box.max[axis];
  const float plane = forward == entry ? low : high;
  // The ray must start on the outer side of a plane of entry, or on the inner side of a plane of exit.
  const float gap = static_cast<float>(random.between(1, 32)) * 0x1p-6F;
  c.ray.origin[axis] = std::clamp(forward ? plane - gap : plane + gap, -1.0F, 1.0F);
  glm::vec3 target = point_of(random, c.box, random.between(0, 2));
  target[axis] = plane;
  const float t = aim(random, c.ray, target);
  c.ray.length = nudged(t, random.between(-1, 1));
  return c;
}

}  // namespace

Case length_at_entry(Random& random) {
  return ending_at_plane(random, true);
}
Case length_at_exit(Random& random) {
  return ending_at_plane(random, false);
}

Case length_zero(Random& random) {
  Case c = aimed_at(random, coarse_box(random), random.between(0, 3));
  if (random.coin()) c.ray.origin = point_of(random, c.box, random.between(0, 3));
  if (random.coin()) disturb(random, c.ray);
  c.ray.length = random.signed_zero();
  return c;
}

Case length_subnormal(Random& random) {
  Case c = aimed_at(random, coarse_box(random), random.between(0, 3));
  if (random.coin()) c.ray.origin = point_of(random, c.box, random.between(0, 3));
  // Within a subnormal length only a direction of about 2^126 or more reaches the box.
  const float scale = std::ldexp(1.0F, random.coin() ? random.between(100, 118) : random.between(-20, 20));
  c.ray.direction *= scale;
  c.ray.length = std::abs(random.of_exponent(-149, -127));
  return c;
}

Case length_huge(Random& random) {
  Case c = aimed_at(random, coarse_box(random), random.between(0, 3));
  c.ray.direction *= std::ldexp(1.0F, -random.between(0, 140));
  give_direction(random, c.ray);
  c.ray.length =
      random.below(4) == 0 ? std::numeric_limits<float>::max() : std::abs(random.of_exponent(20, 127));
  return c;
}

}  // namespace hitpipe::ref::adversary
