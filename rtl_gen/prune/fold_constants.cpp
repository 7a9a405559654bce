#include "rtl_gen/prune/analysis.hpp"
#include "rtl_gen/prune/passes.hpp"
#include "rtl_gen/prune/rewrite.hpp"

namespace hitpipe::rtl {

Graph fold_constants(const Graph& graph, const Demands& demands) {
  const std::vector<Facts> facts = analyse(graph, demands);
  return rewrite(graph, [&](Graph& to, NodeId id, const NewOperands&) {
    const Node& n = graph[id];
    const bool compares = n.op == Op::less || n.op == Op::equal;
    return facts[id].is_constant() && !compares ? to.constant(n.width, facts[id].pattern()) : no_node;
  });
}

}  // namespace hitpipe::rtl
