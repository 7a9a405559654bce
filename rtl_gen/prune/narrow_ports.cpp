#include <bit>

#include "rtl_gen/prune/analysis.hpp"
#include "rtl_gen/prune/passes.hpp"
#include "rtl_gen/prune/read_bits.hpp"
#include "rtl_gen/prune/rewrite.hpp"

namespace hitpipe::rtl {

Graph narrow_ports(const Graph& graph, const Demands& demands) {
  const std::vector<Facts> facts = analyse(graph, demands);
  const std::vector<std::uint64_t> read = read_bits(graph);
  const auto port = [&](Graph& to, NodeId id) {
    const Node& n = graph[id];
    const int width = 64 - std::countl_zero(read[id]);
    if (width == 0) return to.constant(n.width, 0);  // its readers are not read either
    const bool is_signed = n.is_signed && width >= facts[id].signed_width();
    return to.extend(to.input(n.name, width, is_signed), n.width, is_signed);
  };
  return rewrite(graph, port, [](Graph&, NodeId, const NewOperands&) { return no_node; });
}

}  // namespace hitpipe::rtl
