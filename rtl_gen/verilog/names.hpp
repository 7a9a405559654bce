// Verilog names of the values of a graph, from the names in the C++.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "rtl_gen/graph/graph.hpp"
#include "rtl_gen/schedule/registers.hpp"

namespace hitpipe::rtl {

/// One range that holds all bits of a value that anything reads.
struct BitSpan {
  int high = 0;
  int low = 0;
  [[nodiscard]] int width() const { return high - low + 1; }
};
[[nodiscard]] BitSpan used_span(const Graph& graph, const Placement& placement, NodeId value);

/// A name for every input, component and gate. Names are unique, and none is a Verilog keyword. A value has
/// its name from the C++. Where the C++ names only a part of it (a trimmed product) and nothing else of it is
/// used, it takes the name of the part. Where the C++ names nothing, the name is made of the first named
/// reader and the operation.
[[nodiscard]] std::vector<std::string> value_names(const Graph& graph, const Placement& placement,
                                                   std::set<std::string> taken);

}  // namespace hitpipe::rtl
