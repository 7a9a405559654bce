// The neighbours of a box: a cheap way to make many cases for one aimed ray.
#pragma once

#include <span>

#include "sw_ref/judge/adversary/random.hpp"
#include "sw_ref/scene/aabb.hpp"

namespace hitpipe::ref::adversary {

/// The first is the box itself. Each other box has one face moved by up to 4 ulps, or by 2^-30 to 2^-3, in or
/// out. All stay within [-1, 1]^3 with min <= max: if a face would pass its opposite face, that one moves
/// too.
void neighbours(Random& random, const Aabb& box, std::span<Aabb> out);

}  // namespace hitpipe::ref::adversary
