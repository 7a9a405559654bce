// The vectors that `hitpipe rtl` writes. Three eighths are operands of hard rays and boxes, made by the
// design's own set-up, as many are drawn at the ports, and the rest shows what these leave hidden. Rays and
// boxes reach what drawn operands hardly do, such as an origin in a plane. Ports reach what no set-up gives.
#pragma once

#include <cstdint>

#include "rtl_gen/emit/vector_set.hpp"

namespace hitpipe::sim {

/// With these all faults of tests/sim/mutations show.
inline constexpr int usual_vectors = 6000;
inline constexpr std::uint64_t usual_seed = 1;

/// All are drawn at the ports when the design has no set-up of rays and boxes. The same for the same
/// arguments.
[[nodiscard]] rtl::VectorSet design_vectors(const rtl::Design& design, const rtl::Format& format,
                                            std::size_t count, std::uint64_t seed);

}  // namespace hitpipe::sim
