// Rays and boxes that are likely to break ray-box tests, by named category (sections 6.2 and 6.3). They serve
// in tests and for judging a design. The referee accepts every case (rays/exact/box_referee.hpp).
#pragma once

#include <span>
#include <string_view>

#include "rays/mesh/aabb.hpp"
#include "sw_ref/judge/adversary/case.hpp"
#include "sw_ref/judge/adversary/random.hpp"

namespace hitpipe::ref::adversary {

struct Category {
  std::string_view name;  ///< one word, for tables and options
  std::string_view what;  ///< what is special about it
  Case (*make)(Random& random);
};

[[nodiscard]] std::span<const Category> categories();

/// They are not among categories().
[[nodiscard]] std::span<const Category> float_unit_categories();

/// They are not among categories().
[[nodiscard]] std::span<const Category> major_categories();

/// The first is the box itself. Each other box has one face moved by up to 4 ulps, or by 2^-30 to 2^-3, in or
/// out. All stay within [-1, 1]^3 with min <= max: if a face would pass its opposite face, that one moves
/// too.
void neighbours(Random& random, const Aabb& box, std::span<Aabb> out);

}  // namespace hitpipe::ref::adversary
