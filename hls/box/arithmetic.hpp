// The kind of numbers that a pipeline computes with.
#pragma once

namespace hitpipe::hls {

enum class Arithmetic {
  integer,   ///< two's complement; a format is an IntFormat<n, t>
  floating,  ///< binary floating point; a format is an FpFormat<E, M>
};

}  // namespace hitpipe::hls
