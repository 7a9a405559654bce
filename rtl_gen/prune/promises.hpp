// What the ports of the thesis's designs promise anyway, whatever the scene: the ranges in the comments of
// hls/box. A demand that says no more than these leaves a design as it is.
#pragma once

#include "rtl_gen/prune/demands.hpp"

namespace hitpipe::rtl {

/// By the names of the design's ports; of a port that promises nothing there is no demand.
[[nodiscard]] Demands promises(const Design& design, Format format);

}  // namespace hitpipe::rtl
