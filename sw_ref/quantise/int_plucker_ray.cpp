#include "sw_ref/quantise/int_plucker_ray.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "rays/exact/binary32.hpp"
#include "rays/exact/grid.hpp"
#include "rays/world/ray_check.hpp"

namespace hitpipe::ref {

// Why the integer test never misses. G and M are as in grid.hpp. o and d are the ray's origin and
// direction, io and id their rounded forms. e = M d / max |d_i| is the direction before rounding. So |id - e|
// <= 1/2 and |e| <= M on every axis, and |e| = M on one.
//
// The ray that the unit sees. Let ray and box share a point, which is G o + s e in grid units, s >= 0. Move
// it by io - G o, at most 1/2 on every axis: it is then io + s e, and lies in the box grown by half a unit,
// hence in the outward box. So a <= x <= b, where x = s e, and a = ixmin - io and b = ixmax - io are integers
// of at most M in magnitude (int_box.cpp). On the axis with |e| = M this means s M <= M, so s <= 1.
//
// Six edges. Take axes i and j. The unit computes q - p = id_j I - id_i J. I is the upper plane b_i if id_j
// >= 0, otherwise the lower plane a_i, so id_j (I - x_i) >= 0. J is chosen the other way round, so id_i (x_j
// - J) >= 0. For the other edge i and j are exchanged. Hence, as e_j x_i = e_i x_j,
//   q - p >= id_j x_i - id_i x_j = (id_j - e_j) x_i - (id_i - e_i) x_j >= -(|x_i| + |x_j|) / 2 >= -M.
// Equality would need |x_i| = |x_j| = M and thus |e_i| = |e_j| = M, but those are rounded without error. So
// the integer q - p is at least -(M - 1), as section 6.3.2 says. The proof does not use the true signs, so
// the classes may follow the rounded components.
//
// Trimming. floor(q / 2^k) - floor(p / 2^k) >= (q - p - (2^k - 1)) / 2^k >= -(M - 1 + 2^k - 1) / 2^k, and as
// an integer >= -ceil((M - 1) / 2^k): EBND.
//
// Behind. In class plus the unit requires b >= 0. If e >= 0, then b >= x >= 0. If e < 0 was rounded to 0,
// then -1/2 < e, so x = s e > -1/2 and the integer b >= 0. In class minus e < 0, so a <= x <= 0.
//
// Beyond. In class plus the unit requires endpoint >= ixmin. At the common point the ray's coordinate is >= G
// min > ixmin, and the point lies between origin and end. So the larger of the two, rounded up, is large
// enough. That is the end if d >= 0, and the origin if d < 0 was rounded to 0. Class minus is the same with
// the end rounded down. An endpoint outside the cube is ignored, which only adds hits. A coordinate far
// beyond G does not fit n bits, and clamping one to -G in class plus, where a negative d was rounded to 0,
// could cause a miss.

namespace {

__extension__ using Int128 = __int128;

constexpr std::string_view who = "IntPluckerRaySetup";

/// mantissa * 2^exponent in units of 2^-90, rounded down; exact unless exponent < -90.
Int128 fixed_point(Int128 mantissa, int exponent) {
  const int shift = exponent + 90;
  return shift >= 0 ? mantissa * (Int128{1} << shift) : mantissa >> std::min(-shift, 127);
}

/// floor(G (o + t d)), or floor(-G (o + t d)) with `negate`; exact for |o| <= 1, |t d| <= 2.
std::int64_t grid_floor_of_sum(float o, float t, float d, int coord_bits, bool negate) {
  // G o and G t d are integers below 2^54 and 2^78 times powers of two; in units of 2^-90 both stay below
  // 2^121.
  const Binary32 from = decode(negate ? -o : o);
  const Binary32 by = decode(negate ? -d : d);
  const Binary32 times = decode(t);
  const int step_exponent = by.exponent + times.exponent;
  const std::int64_t scale = grid_scale(coord_bits);
  const Int128 start = Int128{scale} * from.mantissa;
  const Int128 step = Int128{scale} * by.mantissa * times.mantissa;
  if (from.exponent < -90 && step_exponent < -90) {
    // Both may have lost bits, and |sum| < 2^-36 + 2^-12, so the sign decides. A double holds t d exactly: it
    // has 48 bits and is no less than 2^-298.
    const double sum_of = static_cast<double>(t) * (negate ? -d : d);
    return sum_of < -static_cast<double>(negate ? -o : o) ? -1 : 0;
  }
  // At most one of the two was rounded down, by less than a unit. That does not change the floor of the sum.
  const Int128 sum = fixed_point(from.negative ? -start : start, from.exponent) +
                     fixed_point(by.negative ? -step : step, step_exponent);
  return static_cast<std::int64_t>(sum >> 90);
}

}  // namespace

IntPluckerRaySetup::IntPluckerRaySetup(const Ray& ray, hls::IntBits bits)
    : exact_(ray), coord_bits_(bits.coord) {
  check_format(bits, who);
  check_ray(ray, who);
  for (int axis = 0; axis < 3; ++axis) {
    // To nearest, ties upwards. The error is at most exactly 1/2, which the half unit of the box covers.
    ray_.origin[static_cast<std::size_t>(axis)] =
        static_cast<std::int32_t>(fine_nearest(ray.origin[axis], coord_bits_));
  }
  set_direction();
  ray_.end = endpoint(ray.length);
}

void IntPluckerRaySetup::set_direction() {
  const glm::vec3& d = exact_.direction;
  const auto limit = static_cast<std::uint64_t>(direction_limit(coord_bits_));
  const Binary32 largest = decode(std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}));
  for (int axis = 0; axis < 3; ++axis) {
    // |e| = M m / (m_largest 2^k), to nearest, ties away from zero, so mirrored rays have mirrored
    // directions.
    const Binary32 parts = decode(d[axis]);
    const int k = largest.exponent - parts.exponent;
    std::uint64_t magnitude = 0;
    if (k < 33) {
      const std::uint64_t twice = 2 * limit * parts.mantissa;                  // < 2^56
      const std::uint64_t denominator = std::uint64_t{largest.mantissa} << k;  // < 2^57
      magnitude = (twice + denominator) / (2 * denominator);
    }
    // From k = 33 on the largest is normal, its mantissa >= 2^23 and the denominator >= 2^56: |e| < 1/2.
    const auto rounded = static_cast<std::int32_t>(magnitude);
    ray_.direction[static_cast<std::size_t>(axis)] = parts.negative ? -rounded : rounded;
  }
}

IntEndpoint IntPluckerRaySetup::endpoint(float length) const {
  check_length(length, who);
  const IntEndpoint nowhere{ray_.origin, true};
  if (std::isinf(length)) {
    return nowhere;
  }
  const std::int64_t limit = grid_scale(coord_bits_);
  IntEndpoint end;
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    const float o = exact_.origin[axis];
    const float d = exact_.direction[axis];
    if (std::abs(static_cast<double>(length) * d) > 2.0) {
      return nowhere;
    }
    // ceil(y) = -floor(-y). Rounded outward along the true direction, so |coordinate| > G just when the
    // endpoint is outside the cube.
    const bool backward = d < 0.0F;
    const std::int64_t outward = grid_floor_of_sum(o, length, d, coord_bits_, !backward);
    if (outward < -limit) {
      return nowhere;
    }
    const bool rounded_to_plus = backward && ray_.direction[i] == 0;
    const std::int64_t coordinate = rounded_to_plus ? -grid_floor_of_sum(o, 0.0F, d, coord_bits_, true)
                                    : backward      ? outward
                                                    : -outward;
    end.at[i] = static_cast<std::int32_t>(coordinate);
  }
  return end;
}

}  // namespace hitpipe::ref
