// The question that a ray answers.
#pragma once

#include <cstdint>

namespace hitpipe::ref {

enum class Query : std::uint8_t {
  closest,  ///< the nearest triangle, ties to the lower index
  any,      ///< stop at the first triangle found: only blocked or not blocked counts
};

}  // namespace hitpipe::ref
