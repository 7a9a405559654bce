// Ray-box pairs for the timings of section 3.5: random, a given share of them hits, as judged by the exact
// referee beforehand.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sw_ref/geometry/aabb.hpp"
#include "sw_ref/geometry/ray.hpp"

namespace hitpipe::ref {

struct BoxPair {
  Ray ray;  ///< infinite, origin in [-1, 1]^3, unit direction (rounded)
  Aabb box;
};

/// No pair is a near miss or a near hit: moving every face by this, in or out, leaves the answer. So tests
/// that round agree on all of them.
inline constexpr float workload_margin = 0x1p-16F;

/// floor(pairs * hit_percent / 100) pairs hit, at random places. Throws std::invalid_argument unless 0 <=
/// hit_percent <= 100.
[[nodiscard]] std::vector<BoxPair> make_box_workload(std::size_t pairs, int hit_percent, std::uint64_t seed);

}  // namespace hitpipe::ref
