// Vectors of the fast tracer.
#pragma once

#include <cstdint>

namespace hitpipe::ref {

/// Which vectors the tracer has. Answers do not depend on them.
enum class VectorWidth : std::uint8_t {
  best,   ///< what is fastest on this processor
  four,   ///< four binary32: SSE2, or plain code
  eight,  ///< eight: AVX2
};

}  // namespace hitpipe::ref
