#include "rays/world/ray_check.hpp"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace hitpipe::ref {

void check_ray(const Ray& ray, std::string_view caller) {
  bool any_nonzero = false;
  for (int axis = 0; axis < 3; ++axis) {
    if (!(std::abs(ray.origin[axis]) <= 1.0F)) {
      throw std::out_of_range(fmt::format("{}: origin.{} = {} is outside the cube; allowed is [-1, 1]",
                                          caller, "xyz"[axis], ray.origin[axis]));
    }
    if (!std::isfinite(ray.direction[axis])) {
      throw std::invalid_argument(fmt::format("{}: direction.{} = {}; components must be finite", caller,
                                              "xyz"[axis], ray.direction[axis]));
    }
    any_nonzero = any_nonzero || ray.direction[axis] != 0.0F;
  }
  if (!any_nonzero) {
    throw std::invalid_argument(
        fmt::format("{}: direction is (0, 0, 0); one component must differ from 0", caller));
  }
}

void check_format(hls::IntBits bits, std::string_view caller) {
  if (!bits.proved()) {
    throw std::invalid_argument(fmt::format("{}: format {}/{}; n must be 6 to 32 and t 6 to 2n-1", caller,
                                            bits.coord, bits.interval));
  }
}

void check_length(float length, std::string_view caller) {
  if (!(length >= 0.0F)) {
    throw std::invalid_argument(fmt::format("{}: length = {}; it must be >= 0 or infinite", caller, length));
  }
}

}  // namespace hitpipe::ref
