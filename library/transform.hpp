// A caller's transform, checked.
#pragma once

#include "hitpipe/ref.h"
#include "rays/scene/normalise.hpp"

namespace hitpipe::library {

/// Of NULL the one that moves nothing. Throws a Refusal unless the numbers are finite and the scale is > 0.
[[nodiscard]] ref::Normalisation checked_transform(const hitpipe_transform* transform);

[[nodiscard]] inline hitpipe_transform c_transform(const ref::Normalisation& own) {
  return {{own.offset.x, own.offset.y, own.offset.z}, own.scale};
}

}  // namespace hitpipe::library
