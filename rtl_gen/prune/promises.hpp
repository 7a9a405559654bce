// What the set-up of a design promises of its operands, whatever the scene: the ranges that its operands
// state (hls/box). A demand that says no more than these leaves the design as it is.
#pragma once

#include "rtl_gen/catalogue/design.hpp"
#include "rtl_gen/prune/demands.hpp"

namespace hitpipe::rtl {

/// A demand for each port whose range is narrower than its width.
[[nodiscard]] Demands promises(const Design& design, const Format& format);

}  // namespace hitpipe::rtl
