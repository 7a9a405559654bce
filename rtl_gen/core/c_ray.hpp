// C text for a core's header: how a host makes a ray of floats into what the core is given.
#pragma once

#include <string>

#include "rtl_gen/core/core.hpp"

namespace hitpipe::rtl {

/// core_make_ray(), which fills `struct core_ray`, and core_distance(). At an integer door it is C99 of 64-bit
/// integers that makes the bits of ref::int_ray() and ref::major_ray(), for every format.
[[nodiscard]] std::string c_ray(const Core& core);

}  // namespace hitpipe::rtl
