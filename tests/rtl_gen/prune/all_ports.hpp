// A fitted graph with the ports that the design had before: it reads only the bits that the fitted ports
// have. Such a unit sees all its operands, so its check block can check every demand.
#pragma once

#include <vector>

#include "rtl_gen/graph/canonical.hpp"
#include "rtl_gen/graph/rewrite.hpp"
#include "rtl_gen/prune/demands.hpp"

namespace hitpipe::rtl {

inline Graph with_all_ports(const Graph& fitted, const std::vector<Port>& original) {
  std::size_t next = 0;
  const auto next_port = [&](Graph& to) {
    const Port& port = original.at(next++);
    return to.input(port.name, port.width, port.is_signed);
  };
  const auto fitted_port = [&](Graph& to, NodeId id) {
    NodeId whole = next_port(to);
    while (to[whole].name != fitted[id].name) whole = next_port(to);
    return to.slice(whole, fitted[id].width - 1, 0);
  };
  const auto as_it_was = [](Graph&, NodeId, const NewOperands&) { return no_node; };
  Graph all = rewrite(fitted, fitted_port, as_it_was);
  while (next < original.size()) next_port(all);
  return canonical(all);
}

}  // namespace hitpipe::rtl
