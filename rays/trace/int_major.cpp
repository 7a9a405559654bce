#include "rays/trace/int_major.hpp"

namespace hitpipe::ref {

MajorDistances::MajorDistances(const IntMajorRay& ray, const hls::MajorBits& bits,
                               const std::array<std::int64_t, 3>& slack)
    : finer_(bits.finer),
      fraction_(bits.fraction),
      mantissa_(bits.mantissa - 1),
      carry_(bits.slope > 0 ? 1 : 0),
      least_(-(std::int64_t{1} << (bits.point() - 1))),
      most_(-least_ - 1) {
  for (std::size_t ray_axis = 0; ray_axis < 3; ++ray_axis) {
    // In the integer world the operand is negated already.
    const std::int64_t negated = bits.slope > 0 ? ray.origin[ray_axis] : -ray.origin[ray_axis];
    ray_axes_[ray_axis] = {static_cast<std::size_t>(ray.axes[ray_axis]),
                           ray.backward[ray_axis] ? -1 : 0,
                           negated - slack[ray_axis],
                           negated + slack[ray_axis],
                           1,
                           1,
                           0};
    if (ray_axis == 0) continue;
    const MajorQuotient& quotient = ray.quotient[ray_axis - 1];
    ray_axes_[ray_axis].floor = quotient.mantissa_low;
    ray_axes_[ray_axis].ceil = quotient.mantissa_high;
    ray_axes_[ray_axis].exponent = quotient.exponent;
  }
}

}  // namespace hitpipe::ref
