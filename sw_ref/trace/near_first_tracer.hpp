// Tracers over nodes that hold the boxes of their children: wide nodes and compact pairs.
#pragma once

#include <memory>

#include "rays/trace/tracer.hpp"
#include "sw_ref/trace/trace_batch.hpp"

namespace hitpipe::ref {

/// How many children a node of the encoding holds the boxes of; 0: its nodes have one box, their own.
[[nodiscard]] std::size_t boxes_in_node(Encoding encoding);

/// Such nodes, with conservative slabs. Wide nodes have the order by distance only. Throws
/// std::invalid_argument, one line, when a box of the hierarchy leaves its parent's.
[[nodiscard]] std::unique_ptr<Tracer> near_first_tracer(Encoding encoding, ChildOrder order, const Mesh& mesh,
                                                        const Bvh& bvh, TriangleTest triangle_test);

}  // namespace hitpipe::ref
