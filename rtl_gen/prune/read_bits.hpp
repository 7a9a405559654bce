// Which bits of every latchable value some output depends on by wires, gates and components.
#pragma once

#include <cstdint>
#include <vector>

#include "rtl_gen/graph/graph.hpp"

namespace hitpipe::rtl {

/// By node; 0 for wires and constants. Nodes without a reader count as readers: run canonical() first.
[[nodiscard]] std::vector<std::uint64_t> read_bits(const Graph& graph);

}  // namespace hitpipe::rtl
