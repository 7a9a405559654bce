// Boxes beside a box: the cheap way to many cases that a ray was aimed at.
#pragma once

#include <span>

#include "sw_ref/adversary/random.hpp"
#include "sw_ref/geometry/aabb.hpp"

namespace hitpipe::ref::adversary {

/// The first is the box itself; each other has one face moved by up to 4 ulps, or by 2^-30 to 2^-3 either
/// way. All stay within [-1, 1]^3 with min <= max: a face that would pass its opposite one takes it along.
void neighbours(Random& random, const Aabb& box, std::span<Aabb> out);

}  // namespace hitpipe::ref::adversary
