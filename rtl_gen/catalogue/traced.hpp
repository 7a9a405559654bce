// A pipeline as a graph: its template run in the trace domain, in any format.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "hls/box/operand.hpp"
#include "hls/num/sized.hpp"
#include "rtl_gen/catalogue/port.hpp"
#include "rtl_gen/graph/trace.hpp"
#include "rtl_gen/graph/trace_fp.hpp"

namespace hitpipe::rtl {

namespace detail {

/// Makes a port of each operand and each result.
template <class Bits>
struct TracedPorts {
  template <bool S>
  void operator()(const hls::Operand& port, Signal<S>& field) const {
    field = Signal<S>(graph.input(port.name, port.width, S));
  }
  template <class F>
  void operator()(const hls::Operand& port, hls::Fp<Trace, F>& field) const {
    field.format = format;
    (*this)(port, field.bits);
  }
  template <bool S>
  void operator()(const hls::Result& port, const Signal<S>& field) const {
    graph.output(port.name, field.id());
  }

  Graph& graph;
  const Bits& format;
};

}  // namespace detail

/// The header of a pipeline's C++, and the headers of pipelines whose parts it uses.
template <class Pipeline>
std::vector<std::string> headers_of() {
  std::vector<std::string> headers{source_line(Pipeline::header, 0).file};
  if constexpr (requires { typename Pipeline::Shares; }) {
    for (std::string& other : headers_of<typename Pipeline::Shares>()) headers.push_back(std::move(other));
  }
  return headers;
}

/// Throws std::runtime_error, one line, when a value is computed outside the pipeline's headers and the
/// shared headers (check_sources), or when a port is too wide (check_ports).
template <class Pipeline>
Graph traced(const typename Pipeline::Bits& format) {
  using Bits = typename Pipeline::Bits;
  using Operands = typename Pipeline::template Operands<Trace, Bits>;
  using Results = typename Pipeline::template Results<Trace, Bits>;
  Graph graph(Pipeline::name);
  const TraceRecorder recorder(graph);
  const detail::TracedPorts<Bits> ports{graph, format};
  Operands in;
  Operands::for_each(format, in, ports);
  const Results out = Pipeline::template test<Trace>(format, in);
  Results::for_each(format, out, ports);
  check_sources(graph, headers_of<Pipeline>());
  check_ports(graph);
  return graph;
}

/// The operand ports of a pipeline, as it states them.
template <class Pipeline>
std::vector<Port> ports_of(const typename Pipeline::Bits& format) {
  std::vector<Port> ports;
  typename Pipeline::template Operands<hls::Sized, typename Pipeline::Bits> in;
  in.for_each(format, in,
              [&](const hls::Operand& operand, const auto&) { ports.push_back(port_of(operand)); });
  return ports;
}

/// The result ports of a pipeline at a format, as it states them.
template <class Pipeline>
std::vector<hls::Result> results_of(const typename Pipeline::Bits& format) {
  std::vector<hls::Result> results;
  typename Pipeline::template Results<hls::Sized, typename Pipeline::Bits> out;
  out.for_each(format, out, [&](const hls::Result& result, const auto&) { results.push_back(result); });
  return results;
}

}  // namespace hitpipe::rtl
