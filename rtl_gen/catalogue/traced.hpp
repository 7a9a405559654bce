// A pipeline as a graph: its template run in the trace domain.
#pragma once

#include "rtl_gen/catalogue/instantiate.hpp"
#include "rtl_gen/catalogue/port.hpp"
#include "rtl_gen/graph/trace.hpp"
#include "rtl_gen/graph/trace_fp.hpp"

namespace hitpipe::rtl {

template <class Pipeline, class F>
Graph traced_at() {
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
    return traced_at<Pipeline, F>;
  }
};

template <class Pipeline, class F>
std::vector<Port> ports_at() {
  std::vector<Port> ports;
  using Operands = typename Pipeline::template Operands<hls::Native, F>;
  Operands in;
  Operands::for_each(in, [&](const hls::Operand& operand, auto&) { ports.push_back(port_of(operand)); });
  return ports;
}
template <class Pipeline>
struct MakePorts {
  static constexpr hls::Arithmetic arithmetic = Pipeline::arithmetic;
  using Entry = std::vector<Port> (*)();
  template <class F>
  static constexpr Entry entry() {
    return ports_at<Pipeline, F>;
  }
};

template <class Pipeline>
Graph traced(const typename Pipeline::Bits& bits) {
  return for_format<MakeTraced<Pipeline>>(bits)();
}
template <class Pipeline>
std::vector<Port> ports_of(const typename Pipeline::Bits& bits) {
  return for_format<MakePorts<Pipeline>>(bits)();
}
template <class Pipeline>
std::vector<hls::Result> results_of() {
  return {{"hit", hls::Meaning::hit, 0, 1, false}};
}

}  // namespace hitpipe::rtl
