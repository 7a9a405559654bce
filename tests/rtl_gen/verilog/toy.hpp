// A pipeline that is small enough to read: d = a - b, chosen by c; its trimmed product with b; and a sign
// that is needed longer than its word.
#pragma once

#include "rtl_gen/pipeline.hpp"
#include "tests/rtl_gen/component/unit_library.hpp"

namespace hitpipe::rtl {

inline Pipeline toy_pipeline() {
  Graph g("toy");
  const NodeId a = g.input("a", 6, true);
  const NodeId b = g.input("b", 6, true);
  const NodeId c = g.input("c", 1, false);
  const NodeId d = g.binary(Op::sub, a, b);
  g.annotate(d, "d", {"hls/pipelines/toy.hpp", 10});
  const NodeId e = g.mux(c, d, g.invert(b));
  g.annotate(e, "e", {"hls/pipelines/toy.hpp", 11});
  const NodeId trimmed = g.slice(g.binary(Op::mul, e, b, true), 10, 5);
  g.annotate(trimmed, "p", {"hls/pipelines/toy.hpp", 12});
  const NodeId sign = g.slice(d, 5, 5);
  const NodeId below = g.binary(Op::less, trimmed, g.extend(sign, 6, true), true);
  g.output("hit", g.invert(g.binary(Op::bit_and, below, sign)));
  g.output("low", g.slice(d, 1, 0));
  return make_pipeline(g, unit_library());
}

}  // namespace hitpipe::rtl
