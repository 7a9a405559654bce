// Rays and triangles of the integer world that are likely to break a triangle test, by named category.
#pragma once

#include <span>
#include <string_view>

#include "hls/world/world_format.hpp"
#include "rays/world/int_ray.hpp"
#include "rays/world/int_triangle.hpp"
#include "sw_ref/judge/adversary/random.hpp"

namespace hitpipe::ref {

struct IntCase {
  IntRay ray;  ///< without an end
  IntTriangle triangle;
};

struct IntCategory {
  std::string_view name;  ///< one word, for tables and options
  std::string_view what;  ///< what is special about it
  IntCase (*make)(adversary::Random& random, const hls::WorldBits& bits);
};

/// In order. Those about ties come last, and only in a format with crossings.
[[nodiscard]] std::span<const IntCategory> int_categories(const hls::WorldBits& bits);

/// The ray and other triangles: the first is the triangle itself, the others have a corner moved by a few
/// units, two corners exchanged, or a corner in the place of another.
void int_neighbours(adversary::Random& random, const IntTriangle& triangle, const hls::WorldBits& bits,
                    std::span<IntTriangle> out);

}  // namespace hitpipe::ref
