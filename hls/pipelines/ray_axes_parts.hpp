// Ray axes: m is the axis M of the direction's largest component, a and b are the other two. An axis and M
// trade places: ray axis a is y, or x when M is y; ray axis b is z, or x when M is z.
#pragma once

#include "hls/num/bits.hpp"

namespace hitpipe {
namespace hls {

/// What belongs to each ray axis.
template <class X>
struct RayAxes {
  X m, a, b;
};

/// From axes to ray axes. `ray` has the bits major_y and major_z.
template <class Ray, class X>
constexpr RayAxes<X> to_ray_axes(const Ray& ray, const X& x, const X& y, const X& z) {
  return {select(ray.major_z, z, select(ray.major_y, y, x)), select(ray.major_y, x, y),
          select(ray.major_z, x, z)};
}

}  // namespace hls
}  // namespace hitpipe
