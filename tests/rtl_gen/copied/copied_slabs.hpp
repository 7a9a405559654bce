// The graph of hls/pipelines/int_slabs.hpp with other names and one changed line, which CMake writes.
#pragma once

#include "hls/box/int_format.hpp"
#include "rtl_gen/graph/graph.hpp"

namespace hitpipe::rtl {

[[nodiscard]] Graph copied_slabs(const hls::IntBits& bits);

}  // namespace hitpipe::rtl
