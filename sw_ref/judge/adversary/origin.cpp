// Cases by the start of the ray: in, on and in front of the box; and boxes around coordinate zero.
#include "sw_ref/judge/adversary/generators.hpp"
#include "sw_ref/judge/adversary/parts.hpp"

namespace hitpipe::ref::adversary {
namespace {

/// A ray that starts at a point with `fixed` coordinates on faces, in any direction.
Case from_box(Random& random, int fixed) {
  const Aabb box = random.coin() ? coarse_box(random) : sized_box(random);
  Case c{.ray = {}, .box = box};
  c.ray.origin = point_of(random, box, fixed);
  const int axis = random.axis();
  if (fixed > 0) c.ray.origin[axis] = within_cube(nudged(c.ray.origin[axis], random.between(-1, 1)));
  c.ray.direction =
      vector_of([&] { return random.below(4) == 0 ? random.signed_zero() : random.signed_unit(); });
  give_direction(random, c.ray);
  switch (random.below(4)) {
    case 0:
      c.ray.length = 0;
      break;
    case 1:
      c.ray.length = std::abs(random.of_exponent(-30, 1));
      break;
    default:
      break;
  }
  return c;
}

}  // namespace

Case touching_origin(Random& random) {
  Aabb box = coarse_box(random);
  const int first = random.axis();
  for (int i = random.between(0, 2); i >= 0; --i) {
    const int axis = (first + i) % 3;
    const float far = std::abs(random.coarse());
    const bool above = random.coin();
    box.min[axis] = above ? random.signed_zero() : -far;
    box.max[axis] = above ? far : random.signed_zero();
  }
  Case c = aimed_at(random, box, random.between(1, 3));
  if (random.coin()) c.ray.origin[random.axis()] = random.signed_zero();
  return c;
}

Case origin_inside(Random& random) {
  return from_box(random, 0);
}
Case origin_on_face(Random& random) {
  return from_box(random, 1);
}
Case origin_on_edge(Random& random) {
  return from_box(random, 2);
}
Case origin_on_corner(Random& random) {
  return from_box(random, 3);
}

Case behind(Random& random) {
  Case c = aimed_at(random, coarse_box(random), random.between(0, 3));
  c.ray.direction = -c.ray.direction;
  if (random.below(4) == 0) {
    const int axis = random.axis();
    c.ray.origin[axis] = c.ray.direction[axis] < 0 ? c.box.min[axis] : c.box.max[axis];
  }
  return c;
}

}  // namespace hitpipe::ref::adversary
