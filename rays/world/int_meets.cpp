#include "rays/world/int_meets.hpp"

#include <array>
#include <cstddef>

#include "rays/world/int128.hpp"

namespace hitpipe::ref {

bool int_meets(const IntRay& ray, const IntBox& box, std::int64_t length, const hls::WorldBits& bits) {
  // Along an axis the ray is in the slab from near / slope to far / slope, in units of 2^S. For slope 0 that
  // says: near
  // <= 0 <= far. Quotients are compared by products of 27 and 33 bits.
  std::array<std::int64_t, 3> near{}, far{}, slope{};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::int64_t low = (std::int64_t{box.min[i]} << bits.finer) - ray.origin[i];
    const std::int64_t high = (std::int64_t{box.max[i]} << bits.finer) - ray.origin[i];
    const bool back = ray.direction[i] < 0;
    near[i] = back ? -high : low;
    far[i] = back ? -low : high;
    slope[i] = back ? -ray.direction[i] : ray.direction[i];
  }
  for (std::size_t i = 0; i < 3; ++i) {
    if (far[i] < 0) return false;
    // floor(2^F near 2^S / slope) <= length, as T is rounded down.
    const Int128 beyond = (static_cast<Int128>(length) + 1) * slope[i];
    const Int128 entered = static_cast<Int128>(near[i]) << (bits.slope + bits.fraction);
    if (slope[i] > 0 ? entered >= beyond : near[i] > 0) return false;
    for (std::size_t j = 0; j < 3; ++j)
      if (i != j && near[i] * slope[j] > far[j] * slope[i]) return false;
  }
  return true;
}

}  // namespace hitpipe::ref
