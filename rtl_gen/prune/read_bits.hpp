// Which bits of every value that can be latched are read.
#pragma once

#include <cstdint>
#include <vector>

#include "rtl_gen/graph/graph.hpp"

namespace hitpipe::rtl {

/// By node; 0 for wires and constants. A node that nothing reads still counts as a reader, so run canonical()
/// first.
[[nodiscard]] std::vector<std::uint64_t> read_bits(const Graph& graph);

}  // namespace hitpipe::rtl
