#include "library/transform.hpp"

#include <cmath>

#include <fmt/format.h>

#include "library/failure.hpp"

namespace hitpipe::library {

ref::Normalisation checked_transform(const hitpipe_transform* transform) {
  if (transform == nullptr) return {};
  const ref::Normalisation own{{transform->offset[0], transform->offset[1], transform->offset[2]},
                               transform->scale};
  const bool finite =
      std::isfinite(own.offset.x) && std::isfinite(own.offset.y) && std::isfinite(own.offset.z);
  if (!finite || !std::isfinite(own.scale) || own.scale <= 0)
    throw Refusal(
        HITPIPE_BAD_ARGUMENT,
        fmt::format("transform: offset ({}, {}, {}), scale {}; they must be finite, and the scale > 0",
                    own.offset.x, own.offset.y, own.offset.z, own.scale));
  return own;
}

}  // namespace hitpipe::library
