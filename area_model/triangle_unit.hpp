// A unit that tests triangles, so that a false HIT of a box test can be priced: the float test of Moeller and
// Trumbore (1997) as a pipeline that begins a test in every cycle. It has no division: distances are compared
// multiplied by the determinant, and only the caller divides, once for a ray's final triangle. It is
// scheduled and priced as every design is. It is not in the catalogue, because hitpipe emits no triangle
// test.
#pragma once

#include "area_model/price.hpp"

namespace hitpipe::area {

/// Its only format is binary32.
[[nodiscard]] const rtl::Design& triangle_unit();

/// The built account. Throws std::runtime_error when the library has no float components.
[[nodiscard]] Price price_of_triangle_unit(const rtl::Library& library);

}  // namespace hitpipe::area
