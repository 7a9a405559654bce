#include "sw_ref/quantise/float_ray.hpp"

#include <cmath>

#include "rays/world/ray_check.hpp"

#ifdef __FAST_MATH__
#error "directed rounding needs IEEE arithmetic: build without -ffast-math"
#endif

namespace hitpipe::ref {
namespace {

/// The least binary32 >= o + step; infinite beyond the largest. o is a binary32. step is a product of two: 48
/// bits in [2^-298, 2^256] or 0, so exact as a double.
float sum_up(double o, double step) {
  // Knuth's two-sum: sum + error = o + step exactly. Nothing overflows, and sums do not underflow.
  const double sum = o + step;
  const double rest = sum - o;
  const double error = (o - (sum - rest)) + (step - rest);
  const auto nearest = static_cast<float>(sum);
  // A binary32 on one side of `sum` is on the same side of the exact sum, because rounding is monotone and
  // does not change a binary32.
  const bool below = nearest < sum || (nearest == sum && error > 0);
  return below ? std::nextafter(nearest, Ray::infinite) : nearest;
}

}  // namespace

glm::vec3 float_irdvc(const glm::vec3& direction) {
  return 1.0F / direction;
}

FloatEndpoint float_endpoint(const Ray& ray, float length) {
  check_length(length, "float_endpoint");
  const FloatEndpoint nowhere{ray.origin, true};
  if (std::isinf(length)) {
    return nowhere;
  }
  FloatEndpoint end;
  for (int axis = 0; axis < 3; ++axis) {
    const double o = ray.origin[axis];
    const double step = static_cast<double>(length) * ray.direction[axis];
    end.at[axis] = ray.direction[axis] < 0.0F ? -sum_up(-o, -step) : sum_up(o, step);
    if (!std::isfinite(end.at[axis])) {
      return nowhere;
    }
  }
  return end;
}

}  // namespace hitpipe::ref
