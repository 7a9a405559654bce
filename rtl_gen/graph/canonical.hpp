// The graph that is scheduled and emitted. It has no dead nodes, its arithmetic is no wider than the bits
// that are used, and its nodes are numbered from the outputs. Compilers evaluate operands in different
// orders, so the numbering must not depend on the order in which nodes were recorded.
#pragma once

#include "rtl_gen/graph/graph.hpp"

namespace hitpipe::rtl {

/// Same inputs (in port order), same outputs, same values. Addition, subtraction, muxes and gates keep only
/// the low bits that some output depends on; multipliers and comparators stay whole.
[[nodiscard]] Graph canonical(const Graph& graph);

}  // namespace hitpipe::rtl
