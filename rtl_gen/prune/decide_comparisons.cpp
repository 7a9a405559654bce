#include "rtl_gen/prune/analysis.hpp"
#include "rtl_gen/prune/passes.hpp"
#include "rtl_gen/prune/rewrite.hpp"

namespace hitpipe::rtl {

Graph decide_comparisons(const Graph& graph, const Demands& demands) {
  const std::vector<Facts> facts = analyse(graph, demands);
  return rewrite(graph, [&](Graph& to, NodeId id, const NewOperands& operands) {
    const Node& n = graph[id];
    if (n.op != Op::less && n.op != Op::equal) return no_node;
    if (facts[id].is_constant()) return to.constant(1, facts[id].pattern());
    // This x < 0 is signed: an unsigned one was decided above.
    const Facts& right = facts[n.args[1]];
    if (n.op == Op::less && right.is_constant() && right.pattern() == 0) {
      const int sign = right.width() - 1;
      return to.slice(operands[0], sign, sign);
    }
    return no_node;
  });
}

}  // namespace hitpipe::rtl
