// Reduces a failing case to the simplest one that still fails, for a person to read.
#pragma once

#include <functional>

#include "sw_ref/judge/adversary/case.hpp"

namespace hitpipe::ref::adversary {

/// Replaces one number at a time by a simpler one: an infinite length, 0, +-1, fewer mantissa bits, or an
/// exponent closer to that of 1. The case must stay acceptable, and `fails` must still be true. Ends when no
/// replacement is left. `fails(c)` must be true for the given case.
[[nodiscard]] Case shrink(Case c, const std::function<bool(const Case&)>& fails);

}  // namespace hitpipe::ref::adversary
