// The simplest case that still fails: what a person reads.
#pragma once

#include <functional>

#include "sw_ref/adversary/case.hpp"

namespace hitpipe::ref::adversary {

/// Replaces one number at a time by a simpler one (an infinite length, 0, +-1, fewer mantissa bits, a smaller
/// exponent's neighbour) as long as the case stays acceptable and `fails` says that it still fails; ends when
/// no replacement is left. `fails(c)` must be true for the case given.
[[nodiscard]] Case shrink(Case c, const std::function<bool(const Case&)>& fails);

}  // namespace hitpipe::ref::adversary
