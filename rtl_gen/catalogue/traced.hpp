// A pipeline as a graph: its template run in the trace domain.
#pragma once

#include "rtl_gen/catalogue/instantiate.hpp"
#include "rtl_gen/graph/trace.hpp"
#include "rtl_gen/graph/trace_fp.hpp"

namespace hitpipe::rtl {

template <class Pipeline, class F>
Graph traced() {
  Graph graph(Pipeline::name);
  const Tracer tracer(graph);
  using Operands = typename Pipeline::template Operands<Trace, F>;
  Operands in;
  Operands::for_each(in, [&]<int W, bool S>(const hls::Operand& port, Signal<W, S>& field) {
    field = Signal<W, S>::from(graph.input(port.name, W, S));
  });
  graph.output("hit", Pipeline::template hit<Trace, F>(in).id());
  return graph;
}

template <class Pipeline>
struct MakeTraced {
  static constexpr hls::Arithmetic arithmetic = Pipeline::arithmetic;
  using Entry = Graph (*)();
  template <class F>
  static constexpr Entry entry() {
    return traced<Pipeline, F>;
  }
};

}  // namespace hitpipe::rtl
