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

/// A slab as exact doubles: distances near / speed and far / speed, speed > 0.
struct ExactSlab {
  double near, far, speed;
};

/// a - b when that is a double, which it is exactly when the rounding error that Knuth's two-sum finds is
/// zero.
std::optional<double> exact_difference(double a, double b) {
  const double difference = a - b;
  const double back = difference - a;
  const double error = (a - (difference - back)) - (b + back);
  return error == 0 ? std::optional(difference) : std::nullopt;
}

/// a * b > c * d, exactly: rounding is monotone, so unequal rounded products have the exact order, and equal
/// ones that of their errors, which fma gives exactly. All factors are 0 or between 2^-149 and 2^129 in
/// magnitude, with bits no lower than 2^-149: nothing overflows, and an error, a multiple of 2^-298, does not
/// underflow.
bool greater_product(double a, double b, double c, double d) {
  const double left = a * b;
  const double right = c * d;
  return left != right ? left > right : std::fma(a, b, -left) > std::fma(c, d, -right);
}

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

BoxReferee::BoxReferee(const Ray& ray) : ray_(ray) {
  for (int axis = 0; axis < 3; ++axis) inverse_[axis] = 1.0 / static_cast<double>(ray.direction[axis]);
}

std::optional<bool> BoxReferee::filtered(const Aabb& box) const {
  double near = 0;
  double far = ray_.length;
  for (int axis = 0; axis < 3; ++axis) {
    const double origin = ray_.origin[axis];
    const double to_min = box.min[axis] - origin;
    const double to_max = box.max[axis] - origin;
    if (ray_.direction[axis] == 0) {
      if (to_min > 0 || to_max < 0) {
        return false;
      }
      continue;
    }
    const double at_min = to_min * inverse_[axis];
    const double at_max = to_max * inverse_[axis];
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

std::optional<bool> ray_meets_box_filtered(const Ray& ray, const Aabb& box) {
  return BoxReferee(ray).filtered(box);
}

std::optional<bool> ray_meets_box_by_products(const Ray& ray, const Aabb& box) {
  std::array<ExactSlab, 3> slabs{};
  std::size_t axes = 0;
  bool apart = false;
  for (int axis = 0; axis < 3; ++axis) {
    const auto to_min = exact_difference(box.min[axis], ray.origin[axis]);
    const auto to_max = exact_difference(box.max[axis], ray.origin[axis]);
    if (!to_min || !to_max) {
      return std::nullopt;
    }
    const double speed = ray.direction[axis];
    if (speed == 0) {
      apart = apart || *to_min > 0 || *to_max < 0;
    } else {
      slabs[axes++] = speed < 0 ? ExactSlab{-*to_max, -*to_min, -speed} : ExactSlab{*to_min, *to_max, speed};
    }
  }
  const double length = ray.length;
  for (std::size_t i = 0; i < axes; ++i) {
    apart = apart || slabs[i].far < 0;
    apart = apart || (!ray.is_infinite() && slabs[i].near > length * slabs[i].speed);  // 48 bits: exact
    for (std::size_t j = 0; j < axes; ++j) {
      apart =
          apart || (i != j && greater_product(slabs[i].near, slabs[j].speed, slabs[j].far, slabs[i].speed));
    }
  }
  return !apart;
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

bool BoxReferee::meets(const Aabb& box) const {
  const std::optional<bool> certain = filtered(box);
  if (certain) {
    return *certain;
  }
  const std::optional<bool> by_products = ray_meets_box_by_products(ray_, box);
  return by_products ? *by_products : ray_meets_box_exact(ray_, box);
}

bool ray_meets_box(const Ray& ray, const Aabb& box) {
  return BoxReferee(ray).meets(box);
}

}  // namespace hitpipe::ref
