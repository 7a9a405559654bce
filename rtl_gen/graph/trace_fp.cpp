#include "rtl_gen/graph/trace_fp.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <string>

#include "rtl_gen/graph/canonical.hpp"

namespace hitpipe::rtl {

namespace {

/// Calls a unit of two floats. `logic(format, a, b)` is traced into its body, unless the graph has that unit
/// already.
template <class Logic>
Trace::uint call(const char* component, const char* result, const FpSignal& a, const FpSignal& b,
                 Logic&& logic) {
  const hls::FpBits& format = a.format;
  Graph& graph = Tracer::graph();
  const std::string name =
      std::string(component) + '_' + std::to_string(format.exponent) + '_' + std::to_string(format.fraction);
  const auto known = std::find_if(graph.units().begin(), graph.units().end(),
                                  [&](const auto& unit) { return unit->body.name() == name; });
  std::shared_ptr<const Unit> unit;
  if (known != graph.units().end()) {
    unit = *known;
  } else {
    Graph body(name);
    const Tracer tracer(body);
    const Trace::uint left(body.input("a", format.width(), false));
    const Trace::uint right(body.input("b", format.width(), false));
    body.output(result, logic(format, left, right).id());
    unit = std::make_shared<const Unit>(Unit{component, format.width(), canonical(body)});
  }
  const std::array<NodeId, 2> operands{a.bits.id(), b.bits.id()};
  return Trace::uint(graph.call(unit, operands));
}

}  // namespace

FpSignal fp_sub(const FpSignal& a, const FpSignal& b) {
  return {call("fp_subtract", "difference", a, b,
               [](const auto& format, const auto& x, const auto& y) {
                 return hls::fp_logic::subtract<Trace>(format, x, y);
               }),
          a.format};
}

FpSignal fp_mul(const FpSignal& a, const FpSignal& b) {
  return {call("fp_multiply", "product", a, b,
               [](const auto& format, const auto& x, const auto& y) {
                 return hls::fp_logic::multiply<Trace>(format, x, y);
               }),
          a.format};
}

hls::Order<Trace::bit> fp_compare(const FpSignal& a, const FpSignal& b) {
  const Trace::uint order =
      call("fp_compare", "order", a, b, [](const auto& format, const auto& x, const auto& y) {
        return hls::fp_logic::compare<Trace>(format, x, y);
      });
  return {slice(order, 0, 0), slice(order, 1, 1)};
}

}  // namespace hitpipe::rtl
