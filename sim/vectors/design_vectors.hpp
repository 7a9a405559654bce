// The vectors that `hitpipe rtl` writes. Three eighths are operands of hard rays and boxes, or triangles, which
// the design's own set-up makes. They have cases that drawn operands seldom have, such as an origin in a plane.
// As many are drawn at the ports. They have numbers that no set-up gives. The rest is chosen to show faults
// that all these leave hidden: bits that no vector has shown, or hits of floats near the ends of their range.
#pragma once

#include <cstdint>

#include "rtl_gen/emit/vectors.hpp"

namespace hitpipe::sim {

/// With these all faults of tests/sim/check/mutations.hpp show.
inline constexpr int usual_vectors = 6000;
inline constexpr std::uint64_t usual_seed = 1;

/// All are drawn at the ports when the design has no such set-up. The same for the same arguments.
[[nodiscard]] rtl::VectorSet design_vectors(const rtl::Design& design, const Format& format,
                                            std::size_t count, std::uint64_t seed);

}  // namespace hitpipe::sim
