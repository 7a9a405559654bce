#include "rays/world/int_ray.hpp"

#include <cmath>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "rays/exact/binary32.hpp"
#include "rays/exact/grid.hpp"
#include "rays/exact/major_quotient.hpp"
#include "rays/world/ray_check.hpp"

namespace hitpipe::ref {

namespace {

constexpr std::string_view door = "int_ray";

/// floor(2^S other / major + 1/2) for 0 <= other <= major, major > 0.
std::int64_t slope(float other, float major, int bits) {
  const Binary32 above = decode(other);
  const Binary32 below = decode(major);
  // other / major = above.mantissa / below.mantissa 2^-down.
  const int down = below.exponent - above.exponent;
  // Then the major component is not subnormal, so its mantissa is at least 2^23 and the slope below 1/2.
  if (down - bits > 26) return 0;
  const auto rounded = [](std::uint64_t numerator, std::uint64_t denominator) {
    return static_cast<std::int64_t>((2 * numerator + denominator) / (2 * denominator));
  };
  const std::uint64_t numerator = above.mantissa;  // below 2^24, and shifted by S below 2^56
  const std::uint64_t denominator = below.mantissa;
  return down <= bits ? rounded(numerator << (bits - down), denominator)
                      : rounded(numerator, denominator << (down - bits));
}

}  // namespace

IntRay int_ray(const Ray& ray, const hls::WorldBits& bits) {
  if (!bits.proved())
    throw std::invalid_argument(fmt::format("{}: there is no format {}+{}s{}t{}", door, bits.coord,
                                            bits.finer, bits.slope, bits.fraction));
  check_ray(ray, door);
  check_length(ray.length, door);
  IntRay made;
  made.major = major_axis(ray.direction);
  const float major = std::abs(ray.direction[made.major]);
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    made.origin[i] = fine_nearest(ray.origin[axis], bits.coord, bits.finer);
    made.negative[i] = ray.direction[axis] < 0.0F;
    const std::int64_t size = slope(std::abs(ray.direction[axis]), major, bits.slope);
    made.direction[i] = made.negative[i] ? -size : size;
  }
  made.length =
      length_along_major(ray.length, major, bits.coord, bits.finer + bits.fraction, bits.largest_distance());
  return made;
}

Ray binary32_ray(const IntRay& ray, const hls::WorldBits& bits) {
  Ray made;
  const auto scale = static_cast<double>(bits.largest_point());
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    made.origin[axis] = static_cast<float>(static_cast<double>(ray.origin[i]) / scale);
    auto size = static_cast<float>(std::abs(ray.direction[i]));
    // It keeps its sign, and its slope is 0.
    if (ray.direction[i] == 0) size = 0x1p-100F;
    // Of components as long as the longest, the first one is the major axis.
    if (axis < ray.major && std::abs(ray.direction[i]) == bits.one()) size = std::nextafter(size, 0.0F);
    made.direction[axis] = ray.negative[i] ? -size : size;
  }
  return made;
}

IntMajorRay major_ray(const IntRay& ray, const hls::MajorBits& bits) {
  IntMajorRay made;
  made.axes = {0, 1, 2};
  std::swap(made.axes[0], made.axes[static_cast<std::size_t>(ray.major)]);
  for (std::size_t ray_axis = 0; ray_axis < 3; ++ray_axis) {
    const auto axis = static_cast<std::size_t>(made.axes[ray_axis]);
    made.backward[ray_axis] = ray.negative[axis];
    made.origin[ray_axis] = ray.negative[axis] ? ray.origin[axis] + 1 : -ray.origin[axis];
    if (ray_axis > 0)
      made.quotient[ray_axis - 1] = quotient_of(
          std::uint64_t{1} << bits.slope, static_cast<std::uint64_t>(std::abs(ray.direction[axis])), bits);
  }
  return made;
}

double t_of_distance(std::int64_t t, const Ray& ray, const hls::WorldBits& bits) {
  const std::int64_t one = grid_scale(bits.coord) << (bits.finer + bits.fraction);
  return static_cast<double>(t) / static_cast<double>(one) /
         std::fabs(ray.direction[major_axis(ray.direction)]);
}

}  // namespace hitpipe::ref
