// Rays and boxes made for the units with a major axis (docs/major.md): what their set-up rounds and what
// their shift saturates. The referee accepts every case.
#pragma once

#include <span>

#include "sw_ref/judge/adversary/categories.hpp"

namespace hitpipe::ref::adversary {

/// They are not among categories().
[[nodiscard]] std::span<const Category> major_categories();

}  // namespace hitpipe::ref::adversary
