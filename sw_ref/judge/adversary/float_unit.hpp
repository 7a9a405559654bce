// Rays and boxes made for the float unit that never misses (docs/conservative.md): what its set-up rounds,
// and where its numbers end. The referee accepts every case.
#pragma once

#include <span>

#include "sw_ref/judge/adversary/categories.hpp"

namespace hitpipe::ref::adversary {

/// They are not among categories().
[[nodiscard]] std::span<const Category> float_unit_categories();

}  // namespace hitpipe::ref::adversary
