#include "rays/world/to_cube.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#ifdef __FAST_MATH__
#error "directed rounding needs IEEE arithmetic: build without -ffast-math"
#endif

namespace hitpipe::ref {
namespace {

/// The least binary32 >= most + rest, or the next one in doubt. |rest| is at most an ulp of `most`.
float binary32_above(double most, double rest, bool in_doubt) {
  const auto nearest = static_cast<float>(most);
  const double past = most - nearest;  // exact
  const bool below = past > -rest || (rest != 0 && past == -rest) || in_doubt;
  return below ? std::nextafter(nearest, std::numeric_limits<float>::infinity()) : nearest;
}

/// Finite binary32s in their order are integers in theirs; both zeros are 0. It is its own inverse but for -0.
std::int32_t place_of(float x) {
  const auto bits = std::bit_cast<std::int32_t>(x);
  return bits < 0 ? std::numeric_limits<std::int32_t>::min() - bits : bits;
}

float at_place(std::int32_t place) {
  return std::bit_cast<float>(place < 0 ? std::numeric_limits<std::int32_t>::min() - place : place);
}

/// The greatest x in [-limit, limit] that becomes at most 1. Moving is monotone. If there is none: the binary32 below
/// -limit.
float greatest_inside(double offset, double scale, float limit) {
  std::int64_t in = std::int64_t{place_of(-limit)} - 1;
  std::int64_t out = std::int64_t{place_of(limit)} + 1;
  while (out - in > 1) {
    const std::int64_t middle = (in + out) >> 1;
    const double own = at_place(static_cast<std::int32_t>(middle));
    (static_cast<float>((own - offset) * scale) <= 1.0F ? in : out) = middle;
  }
  return at_place(static_cast<std::int32_t>(in));
}

}  // namespace

// Knuth's two-sum gives the error of the difference. Fused operations give the error of the product, and the
// sum of both errors, rounded once. If the rounded sum is zero or a tie with a binary32, it does not tell on
// which side the exact number lies.
float plane_above(double own, double offset, double scale) {
  const double difference = own - offset;
  const double back = difference - own;
  const double lost = (own - (difference - back)) - (offset + back);
  const double product = difference * scale;
  const double rest = std::fma(lost, scale, std::fma(difference, scale, -product));
  // The error of a smaller product may not be a double.
  constexpr double error_fits = 0x1p-900;
  return binary32_above(product, rest, difference != 0 && std::abs(product) < error_fits);
}

float plane_below(double own, double offset, double scale) {
  return -plane_above(-own, -offset, scale);
}

Aabb box_to_cube(const BasicAabb<double>& box, const Normalisation& transform) {
  Aabb moved;
  for (int axis = 0; axis < 3; ++axis) {
    moved.min[axis] = plane_below(box.min[axis], transform.offset[axis], transform.scale);
    moved.max[axis] = plane_above(box.max[axis], transform.offset[axis], transform.scale);
  }
  return moved;
}

Ray ray_to_cube(const glm::dvec3& origin, const glm::dvec3& direction, double length,
                const Normalisation& transform) {
  return {glm::vec3(transform.to_cube(origin)), glm::vec3(direction),
          static_cast<float>(length * transform.scale)};
}

Origins origins_in_cube(const Normalisation& transform, float limit) {
  Origins found{};
  for (int axis = 0; axis < 3; ++axis) {
    found.most[axis] = greatest_inside(transform.offset[axis], transform.scale, limit);
    found.least[axis] = -greatest_inside(-transform.offset[axis], transform.scale, limit);
  }
  return found;
}

}  // namespace hitpipe::ref
