// The rays of another program, in a file: what they are, and what each asks.
//
// CSV (number_file.hpp): ox, oy, oz, dx, dy, dz; `length` if some rays end, by default inf; `any` if some ask
// for any hit (1) and not for the closest (0, the default).
// A name that ends in .bin or .rays is binary and little-endian: 8 bytes "hprays1\n", the number of rays as
// uint64, and then for each ray origin, direction and length as 7 float32 and 0 (closest) or 1 (any) as
// uint32.
//
// Origins are in the scene's own units. Directions may have any length; a ray ends at origin + length *
// direction.
#pragma once

#include <string>
#include <vector>

#include "rays/mesh/ray.hpp"
#include "rays/scene/normalise.hpp"
#include "rays/trace/tracer.hpp"

namespace hitpipe::sim {

struct AskedRay {
  ref::Ray ray;
  ref::Query query = ref::Query::closest;
  double outside = 0;  ///< the t before the ray starts in the cube, which its length has lost
};

/// The rays, moved into the cube; all are acceptable(). A ray that starts outside the cube starts where it
/// enters it, as ref::ray_in_cube() says; in a cube that somebody chose it is refused. Throws
/// std::runtime_error, one line that names the file and the line or the ray, for a file that cannot be read,
/// has another form, or holds no ray; and for a ray with a number that is not finite, apart from an infinite
/// length, with the direction 0, with a negative length, or whose origin lies more than 2^20 from the middle
/// of the cube.
[[nodiscard]] std::vector<AskedRay> read_ray_list(const std::string& file, const ref::Normalisation& to_cube);

}  // namespace hitpipe::sim
