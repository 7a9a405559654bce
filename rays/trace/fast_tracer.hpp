// The fastest tracer in software with exact answers: wide nodes whose children are tested together, and
// triangles by four. It copies what it needs of a hierarchy, once, and serves any number of threads.
#pragma once

#include <cstdint>
#include <memory>

#include "rays/trace/tracer.hpp"
#include "rays/trace/vector_width.hpp"

namespace hitpipe::ref {

/// Whether this program and this processor have them.
[[nodiscard]] bool has_vectors(VectorWidth width);

/// The mesh must outlive it, the hierarchy need not. Throws std::invalid_argument, one line, when the
/// hierarchy has no node, a box leaves its parent's, or there are no such vectors. It has no use for an
/// observer of loads. Its counts are of its own nodes.
[[nodiscard]] std::unique_ptr<Tracer> fast_tracer(const Mesh& mesh, const Bvh& bvh,
                                                  VectorWidth width = VectorWidth::best);

}  // namespace hitpipe::ref
