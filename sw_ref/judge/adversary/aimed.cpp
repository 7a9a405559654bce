// Random cases, and rays aimed at a feature of the box: corner, edge, face, or a box without extent.
#include "sw_ref/judge/adversary/generators.hpp"
#include "sw_ref/judge/adversary/parts.hpp"

namespace hitpipe::ref::adversary {
namespace {

Aabb any_box(Random& random) {
  return random.coin() ? coarse_box(random) : sized_box(random);
}

/// A box without extent on `flat` axes, and a ray through one of its points.
Case degenerate(Random& random, int flat) {
  Aabb box = any_box(random);
  const int first = random.axis();
  for (int i = 0; i < flat; ++i) {
    const int axis = (first + i) % 3;
    box.max[axis] = box.min[axis];
  }
  return aimed_at(random, box, random.between(0, 3));
}

}  // namespace

Case random_case(Random& random) {
  Case c{.ray = {}, .box = box_of([&] { return random.signed_unit(); })};
  c.ray.origin = vector_of([&] { return random.signed_unit(); });
  c.ray.direction = vector_of([&] { return random.signed_unit(); });
  give_direction(random, c.ray);
  if (random.coin()) c.ray.length = std::ldexp(1.0F + random.signed_unit(), random.between(-3, 1));
  return c;
}

Case corner(Random& random) {
  return aimed_at(random, any_box(random), 3);
}
Case edge(Random& random) {
  return aimed_at(random, any_box(random), 2);
}
Case face(Random& random) {
  return aimed_at(random, any_box(random), 1);
}

Case flat_box(Random& random) {
  return degenerate(random, 1);
}
Case line_box(Random& random) {
  return degenerate(random, 2);
}
Case point_box(Random& random) {
  return degenerate(random, 3);
}

}  // namespace hitpipe::ref::adversary
