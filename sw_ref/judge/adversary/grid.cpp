// Coordinates at the ends of the integer grid, at its steps and ties, and far below its unit.
#include "rays/exact/grid.hpp"

#include <array>

#include "sw_ref/judge/adversary/generators.hpp"
#include "sw_ref/judge/adversary/parts.hpp"

namespace hitpipe::ref::adversary {
namespace {

/// Scenes lie within +-(1 - 2^-10), their boxes 5e-7 beyond that (section 4.3).
constexpr float scene_margin = 1.0F - 0x1p-10F + 5e-7F;

float end_of_grid(Random& random) {
  const float magnitude =
      std::array{1.0F, nudged(1.0F, -1), nudged(1.0F, -2), scene_margin, 0.5F, 0.0F}[random.below(6)];
  return random.sign() * magnitude;
}

float subnormal(Random& random) {
  return random.coin() ? random.of_exponent(-149, -127) : random.sign() * 0x1p-149F;
}

/// Components halfway between two integers on a scale where the largest is M, and planes that the ray just
/// touches.
Case at_ties(Random& random) {
  const int n = std::array{6, 7, 8, 12, 16, 20, 24}[random.below(7)];
  const auto unit = static_cast<float>(grid_scale(n));
  const auto limit = static_cast<int>(direction_limit(n));
  const int largest = random.axis();
  Case c;
  for (int axis = 0; axis < 3; ++axis) {
    // Twice the component: odd half of the time, and near the largest half of the time.
    const int twice = random.coin() ? 2 * limit - random.between(1, 9) : random.between(0, 2 * limit);
    const auto component = static_cast<float>(axis == largest ? 2 * limit : twice);
    c.ray.direction[axis] = random.sign() * nudged(component, -random.between(0, 1));
    // The origin, in grid units, is at an integer or a tie, in the half of the cube that the ray comes from.
    const float start =
        std::round(unit * (1.0F - std::ldexp(std::abs(random.signed_unit()), -random.between(0, 4)))) -
        (random.coin() ? 0.5F : 0.0F);
    c.ray.origin[axis] = within_cube(nudged(-std::copysign(start / unit, c.ray.direction[axis]),  //
                                            random.between(-1, 1)));
  }
  const double along = 2.0 * std::abs(random.signed_unit());
  for (int axis = 0; axis < 3; ++axis) {
    const double step = along * c.ray.direction[axis] / (2.0 * limit);
    const float touch = within_cube(static_cast<float>(c.ray.origin[axis] + step));
    // Half of the time, put the plane where the ray reaches a whole unit.
    const float plane = random.coin() ? touch : within_cube(std::round(touch * unit) / unit);
    const float extent = static_cast<float>(random.between(0, 2)) / unit;
    const bool above = random.coin();
    c.box.min[axis] = within_cube(above ? plane : plane - extent);
    c.box.max[axis] = within_cube(above ? plane + extent : plane);
  }
  c.ray.length = length_about(random, static_cast<float>(along / (2.0 * limit)));
  return c;
}

/// Mirrors ray and box in the plane where that coordinate is 0.
void mirror(Case& c, int axis) {
  c.ray.origin[axis] = -c.ray.origin[axis];
  c.ray.direction[axis] = -c.ray.direction[axis];
  const float low = c.box.min[axis];
  c.box.min[axis] = -c.box.max[axis];
  c.box.max[axis] = -low;
}

/// The worst effect of rounding on a side relation, which is an error of the direction times a distance. The
/// ray goes from one corner of the cube past an edge near the opposite corner. Two of its components are half
/// a unit off, one up and one down. On their axes the origin is also half a unit off, away from that edge.
Case across_the_cube(Random& random) {
  const int n = std::array{12, 16, 20, 24}[random.below(4)];
  const auto unit = static_cast<double>(grid_scale(n));
  const auto limit = static_cast<int>(direction_limit(n));
  const int up = random.axis();
  const int down = (up + random.between(1, 2)) % 3;
  const int largest = 3 - up - down;

  // Numbers are in grid units, where M is the largest component. At the edge the ray has covered 1 - lag / M
  // of its direction, so on the slower axis it gains slower * lag / M, at most 1/16, over whole units. That
  // must outweigh the effect of the last bits of the coordinates. The edge lies at ties, like the origin, or
  // at whole units.
  const auto few = [&] { return random.between(0, limit / 128); };
  const int slower = 1 + few();
  const int lag = 2 + random.between(0, limit / 16) / slower;
  const int less = few();
  const double distance = limit - less - lag + (random.coin() ? 0.5 : 0.0);
  const double from = random.between(0, std::min(less + lag - 2, limit / 128)) + 0.5 - unit;

  Case c;
  double least = 1.0;
  for (int tries = 0; tries < 8; ++tries) {
    const float scale = 1.5F + random.signed_unit() / 2.0F;
    const double half_up = (limit - less - 0.5) / limit * scale;
    const double half_down = (limit - less - slower - 0.5) / limit * scale;
    const float above = nudged(static_cast<float>(half_up), static_cast<float>(half_up) < half_up ? 1 : 0);
    const float below =
        nudged(static_cast<float>(half_down), static_cast<float>(half_down) < half_down ? 0 : -1);
    const double beside = (above - half_up + half_down - below) / scale;
    if (beside > least) continue;
    least = beside;
    c.ray.direction[largest] = scale;
    c.ray.direction[up] = above;
    c.ray.direction[down] = below;
  }
  c.ray.origin[largest] = -1.0F;
  c.ray.origin[up] = nudged(static_cast<float>(from / unit), random.between(0, 1));
  c.ray.origin[down] = nudged(static_cast<float>(from / unit), -random.between(0, 1));
  const auto extent = static_cast<float>(random.between(0, 2) / unit);
  c.box.max[up] = nudged(static_cast<float>((from + distance) / unit), -random.between(0, 1));
  c.box.min[up] = c.box.max[up] - extent;
  c.box.min[down] = nudged(static_cast<float>((from + distance - slower) / unit), random.between(0, 1));
  c.box.max[down] = within_cube(c.box.min[down] + extent);
  c.box.min[largest] = random.coin() ? c.box.min[up] : -1.0F;
  c.box.max[largest] = 1.0F;
  c.ray.length = length_about(random, (c.box.max[up] - c.ray.origin[up]) / c.ray.direction[up]);
  for (int axis = 0; axis < 3; ++axis) {
    if (random.coin()) mirror(c, axis);
  }
  return c;
}

}  // namespace

Case grid_ends(Random& random) {
  Case c{.ray = {}, .box = box_of([&] { return end_of_grid(random); })};
  c.ray.origin = vector_of([&] { return end_of_grid(random); });
  const float t = aim(random, c.ray, point_of(random, c.box, random.between(0, 3)));
  c.ray.length = length_about(random, t);
  if (random.coin()) disturb(random, c.ray);
  return c;
}

Case one_grid_unit(Random& random) {
  return random.coin() ? at_ties(random) : across_the_cube(random);
}

Case subnormal_coordinates(Random& random) {
  Case c{.ray = {}, .box = coarse_box(random)};
  c.ray.origin = vector_of([&] { return random.coarse(); });
  for (int i = random.between(1, 3); i > 0; --i) {
    const int axis = random.axis();
    const float edge = subnormal(random);
    (edge < 0 ? c.box.max : c.box.min)[axis] = edge;
    if (c.box.min[axis] > c.box.max[axis]) std::swap(c.box.min[axis], c.box.max[axis]);
    if (random.coin()) c.ray.origin[axis] = subnormal(random);
  }
  const float t = aim(random, c.ray, point_of(random, c.box, random.between(0, 3)));
  c.ray.length = length_about(random, t);
  switch (random.below(3)) {
    case 0:
      c.ray.direction[random.axis()] = subnormal(random);
      break;
    case 1:
      c.ray.direction = vector_of([&] { return subnormal(random); });
      c.ray.length = random.coin() ? Ray::infinite : std::abs(random.of_exponent(100, 127));
      break;
    default:
      break;
  }
  give_direction(random, c.ray);
  return c;
}

}  // namespace hitpipe::ref::adversary
