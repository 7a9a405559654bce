#include "rtl_gen/prune/read_bits.hpp"

#include "rtl_gen/graph/sources.hpp"

namespace hitpipe::rtl {

std::vector<std::uint64_t> read_bits(const Graph& graph) {
  std::vector<std::uint64_t> bits(graph.size(), 0);
  const auto read = [&](NodeId source, std::uint64_t mask) { bits[source] |= mask; };
  for (NodeId id = 0; id < graph.size(); ++id) {
    if (is_root(graph[id].op)) for_each_source(graph, id, read);
  }
  for (const Output& out : graph.outputs()) for_each_source_of(graph, out.node, read);
  return bits;
}

}  // namespace hitpipe::rtl
