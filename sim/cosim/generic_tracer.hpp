// A software tracer of any design, over its set-up of rays and boxes and its datapath as a host function.
#pragma once

#include <memory>

#include "sim/software/software.hpp"

namespace hitpipe::sim {

/// Slower than a tracer of its own, because operands are made for each test. Throws as make_feed() does.
[[nodiscard]] std::unique_ptr<ref::Tracer> generic_tracer(const rtl::Design& design, const TracedUnit& unit,
                                                          const ref::Mesh& mesh, const ref::Bvh& bvh);

/// The design's own tracer, or the generic one. Mesh and hierarchy must outlive it.
[[nodiscard]] std::unique_ptr<ref::Tracer> make_tracer(const rtl::Design& design, const TracedUnit& unit,
                                                       const ref::Mesh& mesh, const ref::Bvh& bvh);

/// The size of a node as the design reads it.
[[nodiscard]] std::size_t bytes_per_node(const rtl::Design& design, const Format& format,
                                         const ref::CoarseAxes& coarse = {});

}  // namespace hitpipe::sim
