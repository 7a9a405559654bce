// Random ray-box pairs for the timings of section 3.5. A given share of them are hits; the exact referee
// judges that beforehand.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "rays/mesh/aabb.hpp"
#include "rays/mesh/ray.hpp"
#include "thesis/reference.hpp"

namespace hitpipe::thesis {

struct BoxPair {
  Ray ray;  ///< infinite, origin in [-1, 1]^3, unit direction (rounded)
  Aabb box;
};

/// No pair is a near miss or a near hit: moving every face by this much, in or out, does not change the
/// answer. So tests that round agree on all pairs.
inline constexpr float workload_margin = 0x1p-16F;

/// floor(pairs * hit_percent / 100) pairs are hits, at random places. Throws std::invalid_argument unless 0
/// <= hit_percent <= 100.
[[nodiscard]] std::vector<BoxPair> make_box_workload(std::size_t pairs, int hit_percent, std::uint64_t seed);

}  // namespace hitpipe::thesis
