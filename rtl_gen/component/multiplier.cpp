#include "rtl_gen/component/multiplier.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "rtl_gen/graph/canonical.hpp"

namespace hitpipe::rtl {

Graph multiplier(const MultiplierShape& shape, std::string_view name) {
  Graph g{std::string(name)};
  const NodeId a = g.input("a", shape.width_a, shape.is_signed);
  const NodeId b = g.input("b", shape.width_b, shape.is_signed);
  const int pieces = shape.in_block ? 1 : shape.stages;
  const int piece = (shape.width_b + pieces - 1) / pieces;

  g.begin_stage(1);
  NodeId sum = no_node;  // of the pieces so far; with `is_signed` its top bit is the sign
  int step = 1;
  for (int low = 0; low < shape.width_b; low += piece, ++step) {
    const int high = std::min(low + piece, shape.width_b) - 1;
    const bool top = high == shape.width_b - 1;
    g.begin_stage(1);
    NodeId factor = g.slice(b, high, low);
    // A lower piece has no sign: a zero bit above it makes a signed multiplier read it so.
    if (shape.is_signed && !top) factor = g.extend(factor, g[factor].width + 1, false);
    NodeId product = g.binary(Op::mul, a, factor, shape.is_signed);
    g.annotate(product, fmt::format("piece_{}", step - 1), {});
    if (sum == no_node) {
      sum = product;
      continue;
    }
    g.begin_stage(step);
    const NodeId carried = g.slice(sum, g[sum].width - 1, low);
    const int width = std::min(std::max(g[carried].width, g[product].width) + 1,
                               shape.width_a + shape.width_b - low);  // the whole product is no wider
    const NodeId added = g.binary(Op::add, g.resize(carried, width, shape.is_signed),
                                  g.resize(product, width, shape.is_signed));
    g.annotate(added, fmt::format("sum_{}", step - 1), {});
    sum = g.concat(added, g.slice(sum, low - 1, 0));
  }
  g.output("p",
           g.slice(g.resize(sum, shape.width_a + shape.width_b, shape.is_signed), shape.high, shape.low));
  return canonical(g);
}

}  // namespace hitpipe::rtl
