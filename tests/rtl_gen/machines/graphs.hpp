// The graphs of all machines as text, without the lines of their C++.
#pragma once

#include <string>

#include "rtl_gen/graph/canonical.hpp"
#include "rtl_gen/machine/machine.hpp"

namespace hitpipe::rtl {

/// Canonical graphs do not say in which order the C++ computes.
inline std::string machine_graphs(bool are_canonical) {
  std::string text;
  for (const Machine& machine : machines()) {
    const Graph traced = machine.graph(machine.default_format).graph;
    const std::string graph = to_text(are_canonical ? canonical(traced) : traced);
    for (std::size_t at = 0; at < graph.size();) {
      const std::size_t end = graph.find('\n', at);
      const std::string line = graph.substr(at, end - at);
      text += line.substr(0, line.find(" @ ")) + '\n';
      at = end + 1;
    }
  }
  return text;
}

}  // namespace hitpipe::rtl
