// Verilog names of the values of a graph, from the names in the C++.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "rtl_gen/graph/graph.hpp"
#include "rtl_gen/schedule/registers.hpp"

namespace hitpipe::rtl {

/// The bits of a value that anything reads, as one range.
struct BitSpan {
  int high = 0;
  int low = 0;
  [[nodiscard]] int width() const { return high - low + 1; }
};
[[nodiscard]] BitSpan used_span(const Graph& graph, const Placement& placement, NodeId value);

/// A name for every input, component and gate, unique and no Verilog keyword. A value is called what the C++
/// calls it; one that the C++ names only in part (a trimmed product) takes the part's name when nothing else
/// of it is used; one that the C++ does not name is called after its first named reader and its operation.
[[nodiscard]] std::vector<std::string> value_names(const Graph& graph, const Placement& placement,
                                                   std::set<std::string> taken);

}  // namespace hitpipe::rtl
