#include "rtl_gen/graph/rewrite.hpp"

#include <vector>

namespace hitpipe::rtl {

NodeId record_again(Graph& to, const Graph& from, NodeId id, const NewOperands& operands) {
  const Node& n = from[id];
  switch (n.op) {
    case Op::input:
      break;  // made by rewrite()
    case Op::constant:
      return to.constant(n.width, n.value);
    case Op::slice:
      return to.slice(operands[0], n.low + n.width - 1, n.low);
    case Op::concat:
      return to.concat(operands[0], operands[1]);
    case Op::extend:
      return to.extend(operands[0], n.width, n.is_signed);
    case Op::invert:
      return to.invert(operands[0]);
    case Op::mux:
      return to.mux(operands[0], operands[1], operands[2]);
    case Op::call:
      return to.call(from.submodule_of(id),
                     std::vector<NodeId>(operands.begin(), operands.begin() + n.arity()));
    default:
      return to.binary(n.op, operands[0], operands[1], n.is_signed);
  }
  return no_node;
}

}  // namespace hitpipe::rtl
