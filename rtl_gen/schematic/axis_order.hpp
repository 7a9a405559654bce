// From top to bottom, a drawing shows what belongs to x, y and z.
#pragma once

#include <vector>

#include "rtl_gen/catalogue/port.hpp"
#include "rtl_gen/graph/graph.hpp"

namespace hitpipe::rtl {

/// A place for every node: 1 for x, 2 for y, 3 for z, as the operands' axes say, and 4 for what has no axis.
/// A value has the mean of what it is made of; operands without an axis do not count beside others. `ports`
/// are the design's; the graph may have lost some.
[[nodiscard]] std::vector<double> axis_order(const Graph& graph, const std::vector<Port>& ports);

}  // namespace hitpipe::rtl
