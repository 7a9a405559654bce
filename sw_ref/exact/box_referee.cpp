#include "sw_ref/exact/box_referee.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "sw_ref/exact/wide_int.hpp"

#ifdef __FAST_MATH__
#error "the error bounds of sw_ref/exact need IEEE arithmetic: build without -ffast-math"
#endif

namespace hitpipe::ref {
namespace {

/// Two computed slab distances that differ by this factor are certainly in the computed order. u = 2^-53.
///
/// A distance is q * (1 / d) with q = b - o. b and o are multiples of 2^-149 below 2^128, so q is exactly
/// zero or 2^-149 <= |q| < 2^129, and rounding it to double errs by a factor 1 + u at most. 2^-149 <= |d| <
/// 2^128 puts 1/d in (2^-128, 2^149] and the product, unless zero, in [2^-277, 2^278]: no overflow, no
/// underflow, and one more such factor for each. The computed distance is t (1 + e), |e| <= (1 + u)^3 - 1,
/// less than 4 u, and has the exact sign; max and min keep that bound, and 0 and length enter without error.
/// Hence the computed near <= far (1 - 16 u), with its own rounding, implies
///   near_exact <= near / (1 - 4 u) <= far (1 - 15 u) / (1 - 4 u)
///              <= far_exact (1 + 4 u) (1 - 15 u) / (1 - 4 u) <= far_exact,
/// and so with the names exchanged.
constexpr double order_margin = 1.0 - 0x1p-49;

}  // namespace

bool acceptable(const Ray& ray) {
  bool any_nonzero = false;
  for (int axis = 0; axis < 3; ++axis) {
    if (!(std::abs(ray.origin[axis]) <= 1.0F) || !std::isfinite(ray.direction[axis])) {
      return false;
    }
    any_nonzero = any_nonzero || ray.direction[axis] != 0.0F;
  }
  return any_nonzero && ray.length >= 0.0F;
}

bool acceptable(const Aabb& box) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!(box.min[axis] >= -1.0F && box.min[axis] <= box.max[axis] && box.max[axis] <= 1.0F)) {
      return false;
    }
  }
  return true;
}

std::optional<bool> ray_meets_box_filtered(const Ray& ray, const Aabb& box) {
  double near = 0;
  double far = ray.length;
  for (int axis = 0; axis < 3; ++axis) {
    const double origin = ray.origin[axis];
    const double direction = ray.direction[axis];
    const double to_min = box.min[axis] - origin;
    const double to_max = box.max[axis] - origin;
    if (direction == 0) {
      if (to_min > 0 || to_max < 0) {
        return false;
      }
      continue;
    }
    const double inverse = 1.0 / direction;
    const double at_min = to_min * inverse;
    const double at_max = to_max * inverse;
    near = std::max(near, std::min(at_min, at_max));
    far = std::min(far, std::max(at_min, at_max));
  }
  if (far < 0) {
    return false;  // signs are exact: the box lies behind the origin
  }
  if (near == 0 || near <= far * order_margin) {
    return true;
  }
  if (near * order_margin > far) {
    return false;
  }
  return std::nullopt;
}

bool ray_meets_box_exact(const Ray& ray, const Aabb& box) {
  // Distances as fractions: near[axis] / speed[axis] and far[axis] / speed[axis], speed > 0.
  std::array<WideInt, 3> near;
  std::array<WideInt, 3> far;
  std::array<WideInt, 3> speed;
  int axes = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const WideInt origin = in_units(ray.origin[axis]);
    WideInt to_min = in_units(box.min[axis]) - origin;
    WideInt to_max = in_units(box.max[axis]) - origin;
    const WideInt direction = in_units(ray.direction[axis]);
    if (direction == 0) {
      if (to_min > 0 || to_max < 0) {
        return false;
      }
      continue;
    }
    const auto slot = static_cast<std::size_t>(axes++);
    const bool backwards = direction < 0;
    near[slot] = backwards ? WideInt(-to_max) : to_min;
    far[slot] = backwards ? WideInt(-to_min) : to_max;
    speed[slot] = abs(direction);
    if (far[slot] < 0) {
      return false;
    }
    if (!ray.is_infinite() && (near[slot] << unit_bits) > in_units(ray.length) * speed[slot]) {
      return false;
    }
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(axes); ++i) {
    for (std::size_t j = 0; j < static_cast<std::size_t>(axes); ++j) {
      if (i != j && near[i] * speed[j] > far[j] * speed[i]) {
        return false;
      }
    }
  }
  return true;
}

bool ray_meets_box(const Ray& ray, const Aabb& box) {
  const std::optional<bool> certain = ray_meets_box_filtered(ray, box);
  return certain ? *certain : ray_meets_box_exact(ray, box);
}

}  // namespace hitpipe::ref
