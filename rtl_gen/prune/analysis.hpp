// Interval and known-bits analysis of a graph: what is known of every value while the operands meet the
// demands. It is sound for every operation. For a component with logic of its own (a float operator) it
// analyses that logic.
#pragma once

#include <vector>

#include "rtl_gen/graph/graph.hpp"
#include "rtl_gen/prune/facts.hpp"

namespace hitpipe::rtl {

/// By node. The demands must have passed check_demands() for the graph's ports.
[[nodiscard]] std::vector<Facts> analyse(const Graph& graph, const Demands& demands);

/// What a demand tells of its port, which has this width and sign.
[[nodiscard]] Facts facts_of(const PortDemand& demand, int width, bool is_signed);

}  // namespace hitpipe::rtl
