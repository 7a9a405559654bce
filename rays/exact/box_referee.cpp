#include "rays/exact/box_referee.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "rays/exact/wide_int.hpp"

#ifdef __FAST_MATH__
#error "the error bounds of rays/exact need IEEE arithmetic: build without -ffast-math"
#endif

namespace hitpipe::ref {
namespace {

/// Two computed slab distances that differ by this factor are certainly in the computed order. u = 2^-53.
///
/// A distance is q * (1 / d) with q = b - o. b and o are multiples of 2^-149 below 2^128, so q is exactly
/// zero or 2^-149 <= |q| < 2^129. Rounding q to double errs by a factor of at most 1 + u. As 2^-149 <= |d| <
/// 2^128, 1/d is in (2^-128, 2^149] and the product, unless zero, in [2^-277, 2^278]. Neither overflows or
/// underflows, and each adds one more such factor. So the computed distance is t (1 + e) with |e| <= (1 +
/// u)^3 - 1 < 4 u, and it has the exact sign. max and min keep that bound; 0 and length have no error. Hence
/// the computed near <= far (1 - 16 u), with its own rounding, implies
///   near_exact <= near / (1 - 4 u) <= far (1 - 15 u) / (1 - 4 u)
///              <= far_exact (1 + 4 u) (1 - 15 u) / (1 - 4 u) <= far_exact,
/// and the same with near and far exchanged.
constexpr double order_margin = 1.0 - 0x1p-49;

/// hi + lo exactly, hi their sum rounded to nearest.
struct Sum {
  double hi, lo;
};

/// Knuth's two-sum. For the sums below nothing overflows, and a sum does not underflow.
Sum exact_sum(double a, double b) {
  const double hi = a + b;
  const double rest = hi - a;
  return {hi, (a - (hi - rest)) + (b - rest)};
}

/// a * b exactly. Factors are 0 or between 2^-149 and 2^129 in magnitude, with no bits below 2^-149. So
/// nothing overflows, and the error, a multiple of 2^-298, does not underflow.
Sum exact_product(double a, double b) {
  const double hi = a * b;
  return {hi, std::fma(a, b, -hi)};
}

/// The exact sum of doubles as an expansion: doubles of growing magnitude that do not overlap. The largest
/// one that is not zero has the sign of the sum (Shewchuk 1997, theorem 10).
template <std::size_t N>
bool sum_is_positive(const std::array<double, N>& terms) {
  std::array<double, N> expansion{};
  for (std::size_t i = 0; i < N; ++i) {
    double carried = terms[i];
    for (std::size_t j = 0; j < i; ++j) {
      const Sum sum = exact_sum(carried, expansion[j]);
      expansion[j] = sum.lo;
      carried = sum.hi;
    }
    expansion[i] = carried;
  }
  for (std::size_t i = N; i > 0; --i) {
    if (expansion[i - 1] != 0) return expansion[i - 1] > 0;
  }
  return false;
}

/// (a.hi + a.lo) * b > (c.hi + c.lo) * d, exactly. A rounded product of a rounded sum and a factor errs by
/// less than 2.1 * 2^-53 of itself; two of them err by less than 2^-51 of the larger. Rounding is monotone:
/// if both low parts are 0, unequal rounded products have the exact order.
bool greater_product(const Sum& a, double b, const Sum& c, double d) {
  const double about_left = a.hi * b;
  const double about_right = c.hi * d;
  const double largest = std::max(std::abs(about_left), std::abs(about_right));
  if (std::abs(about_left - about_right) > 0x1p-50 * largest) return about_left > about_right;
  const Sum left = exact_product(a.hi, b);
  const Sum right = exact_product(c.hi, d);
  if (a.lo == 0 && c.lo == 0) return left.hi != right.hi ? left.hi > right.hi : left.lo > right.lo;
  const Sum low_left = exact_product(a.lo, b);
  const Sum low_right = exact_product(c.lo, d);
  return sum_is_positive<8>(
      {low_left.lo, -low_right.lo, low_left.hi, -low_right.hi, left.lo, -right.lo, left.hi, -right.hi});
}

/// Distances near / speed and far / speed, speed > 0, all exact.
struct ExactSlab {
  Sum near, far;
  double speed;
};

Sum negated(const Sum& a) {
  return {-a.hi, -a.lo};
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

BoxReferee::BoxReferee(const Ray& ray) : ray_(ray), origin_(ray.origin), length_(ray.length) {
  for (int axis = 0; axis < 3; ++axis) {
    // The inverse of zero is an infinity. A plane is then infinitely far on one side, or its distance is NaN
    // if it contains the ray.
    inverse_[axis] = 1.0 / static_cast<double>(ray.direction[axis]);
    const bool backward = std::signbit(ray.direction[axis]);
    near_face_[static_cast<std::size_t>(axis)] = static_cast<unsigned>(axis + (backward ? 3 : 0));
  }
}

BoxReferee::Verdict BoxReferee::judged(const Aabb& box) const {
  double near = 0;
  double far = length_;
  for (int axis = 0; axis < 3; ++axis) {
    const unsigned face = near_face_[static_cast<std::size_t>(axis)];
    const auto opposite = static_cast<unsigned>(2 * axis + 3) - face;
    const double at_near = (box.plane(face) - origin_[axis]) * inverse_[axis];
    const double at_far = (box.plane(opposite) - origin_[axis]) * inverse_[axis];
    near = at_near > near ? at_near : near;  // a NaN is ignored
    far = at_far < far ? at_far : far;
  }
  // near >= 0, and signs are exact: far < 0 means a box behind the origin, near = 0 <= far a box that is met.
  // far is not +infinity, because one component is not zero.
  return {near <= far * order_margin, near * order_margin > far};
}

std::optional<bool> BoxReferee::filtered(const Aabb& box) const {
  const Verdict verdict = judged(box);
  return verdict.met || verdict.missed ? std::optional(verdict.met) : std::nullopt;
}

std::optional<bool> ray_meets_box_filtered(const Ray& ray, const Aabb& box) {
  return BoxReferee(ray).filtered(box);
}

bool ray_meets_box_by_products(const Ray& ray, const Aabb& box) {
  std::array<ExactSlab, 3> slabs{};
  std::size_t axes = 0;
  bool apart = false;
  for (int axis = 0; axis < 3; ++axis) {
    const double origin = ray.origin[axis];
    const Sum to_min = exact_sum(box.min[axis], -origin);
    const Sum to_max = exact_sum(box.max[axis], -origin);
    const double speed = ray.direction[axis];
    if (speed == 0) {
      apart = apart || to_min.hi > 0 || to_max.hi < 0;
    } else {
      slabs[axes++] =
          speed < 0 ? ExactSlab{negated(to_max), negated(to_min), -speed} : ExactSlab{to_min, to_max, speed};
    }
  }
  const double length = ray.length;
  for (std::size_t i = 0; i < axes; ++i) {
    apart = apart || slabs[i].far.hi < 0;
    if (!ray.is_infinite()) {
      // This product has 48 bits and is exact. The rounded sum is above it, or equal to it, and then the
      // error of the sum decides.
      const double end = length * slabs[i].speed;
      apart = apart || slabs[i].near.hi > end || (slabs[i].near.hi == end && slabs[i].near.lo > 0);
    }
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
  const Verdict verdict = judged(box);
  return verdict.met || (!verdict.missed && ray_meets_box_by_products(ray_, box));
}

[[gnu::flatten]] void BoxReferee::meet(std::span<const Aabb> boxes, std::span<bool> out) const {
  for (std::size_t i = 0; i < boxes.size(); ++i) out[i] = meets(boxes[i]);
}

bool ray_meets_box(const Ray& ray, const Aabb& box) {
  return BoxReferee(ray).meets(box);
}

}  // namespace hitpipe::ref
