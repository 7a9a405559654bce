// C that reads the header of an image, and goes between a mesh's own units and a core's.
#pragma once

#include <string>

#include "rtl_gen/core/core.hpp"

namespace hitpipe::rtl {

/// For the core's C header, behind its rays (c_ray.hpp).
[[nodiscard]] std::string c_image(const Core& core);

}  // namespace hitpipe::rtl
