// Directions with components that are zero, that round to zero, or that differ by orders of magnitude.
#include <array>

#include "sw_ref/judge/adversary/generators.hpp"
#include "sw_ref/judge/adversary/parts.hpp"

namespace hitpipe::ref::adversary {
namespace {

/// A coordinate inside [low, high], at one of its ends, or an ulp from an end.
float about(Random& random, float low, float high) {
  const float at = std::array{low, high, (low + high) / 2}[random.below(3)];
  return within_cube(nudged(at, random.between(-1, 1)));
}

/// A ray along one axis that starts inside or near the box's slabs of the other axes.
Case along_axis(Random& random, int moving) {
  Case c{.ray = {}, .box = coarse_box(random)};
  for (int axis = 0; axis < 3; ++axis) {
    const bool moves = axis == moving;
    c.ray.origin[axis] = moves ? random.coarse() : about(random, c.box.min[axis], c.box.max[axis]);
    c.ray.direction[axis] = moves ? random.sign() : random.signed_zero();
  }
  // Most of these rays go towards the box.
  if (random.below(4) != 0) {
    c.ray.direction[moving] = c.ray.origin[moving] < c.box.max[moving] ? 1.0F : -1.0F;
  }
  c.ray.length = length_about(random, std::abs(c.box.min[moving] - c.ray.origin[moving]));
  return c;
}

}  // namespace

Case axis_parallel(Random& random) {
  Case c = along_axis(random, random.axis());
  const float scale = std::ldexp(1.0F, random.between(-100, 100));
  c.ray.direction *= scale;
  c.ray.length /= scale;
  return c;
}

Case nearly_axis_parallel(Random& random) {
  const int moving = random.axis();
  Case c = along_axis(random, moving);
  // An n-bit direction component below 1 / (2 M) rounds to zero (M is direction_limit()).
  const auto limit = static_cast<float>((std::int64_t{1} << (random.between(6, 32) - 1)) - 1);
  for (int axis = 0; axis < 3; ++axis) {
    if (axis == moving) continue;
    const auto halves = static_cast<float>(random.between(0, 5));
    c.ray.direction[axis] = random.sign() * nudged(halves / 2 / limit, random.between(0, 2));
    if (random.below(4) == 0) c.ray.direction[axis] = random.of_exponent(-149, -6);
  }
  return c;
}

Case in_face_plane(Random& random) {
  Case c = aimed_at(random, coarse_box(random), random.between(1, 3));
  const int axis = random.axis();
  c.ray.direction[axis] = random.signed_zero();
  give_direction(random, c.ray);
  const float plane = random.coin() ? c.box.min[axis] : c.box.max[axis];
  c.ray.origin[axis] = within_cube(nudged(plane, random.between(-1, 1)));
  return c;
}

Case zero_components(Random& random) {
  const Aabb box = random.coin() ? coarse_box(random) : sized_box(random);
  Case c = aimed_at(random, box, random.between(0, 3));
  for (int i = random.between(1, 2); i > 0; --i) {
    const int axis = random.axis();
    c.ray.direction[axis] = random.signed_zero();
    if (random.coin()) {
      c.box.min[axis] = std::min(c.box.min[axis], random.signed_zero());
      c.box.max[axis] = std::max(c.box.max[axis], random.signed_zero());
      if (random.coin()) c.box.min[axis] = random.signed_zero();
      if (random.coin()) c.ray.origin[axis] = random.signed_zero();
    }
  }
  give_direction(random, c.ray);
  return c;
}

Case stiff(Random& random) {
  Case c{.ray = {}, .box = coarse_box(random)};
  const int fast = random.axis();
  const int middle = (fast + random.between(1, 2)) % 3;
  const int slow = 3 - fast - middle;
  const int exponent = random.between(0, 100);
  const int ratio = random.between(0, 149);
  c.ray.direction[fast] = random.sign() * std::ldexp(1.25F, exponent);
  c.ray.direction[middle] = random.of_exponent(0, 0) * std::ldexp(1.0F, exponent - random.between(0, ratio));
  c.ray.direction[slow] = random.of_exponent(0, 0) * std::ldexp(1.0F, exponent - ratio);
  // Start so that the ray passes near a point of the box.
  const glm::vec3 target = point_of(random, c.box, random.between(0, 3));
  const float distance = std::abs(random.coarse());
  for (int axis = 0; axis < 3; ++axis) {
    const double share = static_cast<double>(c.ray.direction[axis]) / std::ldexp(1.25, exponent);
    c.ray.origin[axis] = within_cube(static_cast<float>(target[axis] - distance * share));
  }
  const float t = std::ldexp(distance / 1.25F, -exponent);
  c.ray.length = length_about(random, t);
  return c;
}

Case exponent_extremes(Random& random) {
  Case c = aimed_at(random, coarse_box(random), random.between(0, 3));
  for (int axis = 0; axis < 3; ++axis) {
    if (random.coin()) c.ray.origin[axis] = (c.box.min[axis] + c.box.max[axis]) / 2;
    if (random.coin()) {
      c.ray.direction[axis] = std::copysign(random.of_exponent(-149, 127), c.ray.direction[axis]);
    }
  }
  if (random.below(4) == 0) c.ray.direction = vector_of([&] { return random.of_exponent(-149, 127); });
  if (random.coin()) c.ray.length = std::abs(random.of_exponent(-149, 127));
  give_direction(random, c.ray);
  return c;
}

}  // namespace hitpipe::ref::adversary
