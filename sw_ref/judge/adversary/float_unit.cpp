#include <array>

#include "sw_ref/judge/adversary/categories.hpp"
#include "sw_ref/judge/adversary/parts.hpp"

namespace hitpipe::ref::adversary {
namespace {

/// M of some format.
int fraction_bits(Random& random) {
  return random.coin() ? std::array{7, 10, 15, 23}[random.below(4)] : random.between(1, 23);
}

/// The bias of some format: numbers go from 2^(1 - bias) to 2^(bias + 1).
int bias_of_format(Random& random) {
  return random.coin() ? std::array{127, 15}[random.below(2)] : (1 << random.between(1, 7)) - 1;
}

/// In [-1, 1]: a number of few bits, halfway between two of them, or an ulp beside.
float short_number(Random& random, int bits) {
  if (random.below(12) == 0) return random.signed_zero();
  const auto steps = static_cast<std::uint64_t>(1) << bits;
  const auto fraction = static_cast<float>(random.below(2 * steps)) / static_cast<float>(2 * steps);
  const int power = random.below(4) == 0 ? random.between(0, 20) : random.between(0, 5);
  const float x = std::ldexp(1.0F + fraction, -1 - power);
  return random.sign() * within_cube(nudged(x, random.below(3) == 0 ? random.between(-1, 1) : 0));
}

/// A box with faces where the ray is after `along` times its direction, to within an ulp. The box lies on
/// either side of each.
Case box_on_ray(Random& random, const Ray& ray, float along, int bits) {
  Case c{.ray = ray, .box = {}};
  for (int axis = 0; axis < 3; ++axis) {
    const double at = ray.origin[axis] + static_cast<double>(along) * ray.direction[axis];
    const float face = within_cube(nudged(static_cast<float>(std::clamp(at, -1.0, 1.0)),
                                          random.below(4) == 0 ? random.between(-1, 1) : 0));
    const std::array extents{0.0F, std::ldexp(std::abs(short_number(random, bits)), -random.between(0, 24)),
                             std::abs(random.coarse())};
    const float extent = extents[random.below(3)];
    const bool below = random.coin();
    c.box.min[axis] = within_cube(below ? face - extent : face);
    c.box.max[axis] = within_cube(below ? face : face + extent);
  }
  const float scale = std::ldexp(1.0F, random.between(-20, 20));
  c.ray.direction *= scale;
  give_direction(random, c.ray);
  c.ray.length = length_about(random, std::max(along, 0.0F) / scale);
  return c;
}

/// Numbers of a format, halfway between them and next to them, as coordinates and as components.
Case short_fractions(Random& random) {
  const int bits = fraction_bits(random);
  Ray ray;
  ray.origin = vector_of([&] { return short_number(random, bits); });
  ray.direction = vector_of([&] { return short_number(random, bits); });
  return box_on_ray(random, ray, random.coin() ? 1.0F : std::abs(random.signed_unit()), bits);
}

/// Components whose inverse is a number of the format, or an ulp beside one.
Case inverse_ends(Random& random) {
  const int bits = fraction_bits(random);
  Ray ray;
  ray.origin = vector_of([&] { return short_number(random, bits); });
  ray.direction = vector_of([&] {
    const auto steps = static_cast<float>(1 << bits);
    const float inverse = 1.0F + static_cast<float>(random.below(1U << bits)) / steps;
    return random.sign() * std::ldexp(nudged(1.0F / inverse, random.between(-1, 1)), -random.between(0, 6));
  });
  return box_on_ray(random, ray, std::abs(random.signed_unit()), bits);
}

/// Component ratios about the largest number of a format, so that inverses and distances run over it.
Case float_overflow(Random& random) {
  const int bits = fraction_bits(random);
  const int bias = bias_of_format(random);
  Ray ray;
  ray.origin = vector_of([&] { return short_number(random, bits); });
  const int major = random.axis();
  for (int axis = 0; axis < 3; ++axis) {
    const int power = axis == major ? 0 : bias + random.between(-3, 2);
    ray.direction[axis] = random.sign() * std::ldexp(nudged(1.0F, random.between(-2, 2)), -power);
    if (axis != major && random.below(6) == 0) ray.direction[axis] = random.signed_zero();
  }
  return box_on_ray(random, ray, std::abs(random.signed_unit()), bits);
}

/// Planes whose distance from the origin is about the least normal or subnormal number of a format, or zero.
Case small_differences(Random& random) {
  const int bits = fraction_bits(random);
  const int bias = bias_of_format(random);
  Ray ray;
  for (int axis = 0; axis < 3; ++axis) {
    const bool near_zero = random.coin();
    ray.origin[axis] =
        near_zero ? random.sign() * within_cube(std::ldexp(1.0F, 1 - bias - random.between(-2, bits + 1)))
                  : short_number(random, bits);
    ray.direction[axis] = random.below(5) == 0 ? random.signed_zero() : short_number(random, bits);
  }
  const float along =
      std::ldexp(std::abs(short_number(random, bits)), 1 - bias + random.between(-bits - 2, 2));
  return box_on_ray(random, ray, random.below(4) == 0 ? 0.0F : along, bits);
}

/// A ray along one or two axes, in the plane of a face of the box or next to it.
Case parallel_faces(Random& random) {
  const int bits = fraction_bits(random);
  Ray ray;
  ray.origin = vector_of([&] { return short_number(random, bits); });
  for (int axis = 0; axis < 3; ++axis)
    ray.direction[axis] = random.coin() ? random.signed_zero() : short_number(random, bits);
  give_direction(random, ray);
  Case c = box_on_ray(random, ray, std::abs(random.signed_unit()), bits);
  for (int axis = 0; axis < 3; ++axis) {
    if (c.ray.direction[axis] != 0.0F) continue;
    const float face =
        within_cube(nudged(c.ray.origin[axis], random.below(3) == 0 ? random.between(-1, 1) : 0));
    (random.coin() ? c.box.min : c.box.max)[axis] = face == 0.0F ? random.signed_zero() : face;
    if (c.box.min[axis] > c.box.max[axis]) std::swap(c.box.min[axis], c.box.max[axis]);
  }
  return c;
}

/// Rays whose length is about the least or the largest number of a format, on the scale of its distances.
Case float_lengths(Random& random) {
  const int bits = fraction_bits(random);
  const int bias = bias_of_format(random);
  Ray ray;
  ray.origin = vector_of([&] { return short_number(random, bits); });
  ray.direction = vector_of([&] { return short_number(random, bits); });
  const bool large = random.coin();
  Case c = box_on_ray(random, ray, large ? 1.0F : 0.0F, bits);
  const int power =
      large ? std::min(bias + random.between(-1, 2), 127) : 1 - bias - random.between(-2, bits + 2);
  c.ray.length = std::max(0.0F, nudged(std::ldexp(1.0F, power), random.between(-2, 0)));
  return c;
}

}  // namespace

std::span<const Category> float_unit_categories() {
  static constexpr Category table[] = {
      {"short_fractions", "coordinates and components of few bits, halfway between such, or an ulp beside",
       short_fractions},
      {"inverse_ends", "components whose inverse has few bits, or an ulp beside", inverse_ends},
      {"float_overflow", "component ratios about the largest number of a short format, and zeros",
       float_overflow},
      {"small_differences", "planes as far from the origin as a format's least numbers, or in it",
       small_differences},
      {"parallel_faces", "rays along one or two axes in the plane of a face, or an ulp beside",
       parallel_faces},
      {"float_lengths", "lengths about the least and the largest number of a format", float_lengths},
  };
  return table;
}

}  // namespace hitpipe::ref::adversary
