// Rays and boxes of an adversary's category as operands of a unit, made by the design's own set-up.
#pragma once

#include <cstdint>
#include <vector>

#include "sw_ref/judge/adversary/categories.hpp"
#include "tests/sim/units.hpp"

namespace hitpipe::sim {

[[nodiscard]] std::vector<std::vector<std::int64_t>> adversary_vectors(
    const TestedUnit& unit, const ref::adversary::Category& category, int count, std::uint64_t seed);

/// Raw operands, most of them corner values. Each port is drawn independently.
[[nodiscard]] std::vector<std::vector<std::int64_t>> raw_corner_vectors(const TestedUnit& unit, int count,
                                                                        std::uint64_t seed);

}  // namespace hitpipe::sim
