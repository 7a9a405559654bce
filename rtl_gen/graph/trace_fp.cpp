#include "rtl_gen/graph/trace_fp.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <string>

#include "rtl_gen/graph/canonical.hpp"

namespace hitpipe::rtl {

namespace {

/// A unit of two numbers: which component it is, and the width at which a library is asked.
struct Operator {
  const char* component;
  const char* result;
  int bits;
};

/// Calls a unit. `logic(format, a, b)` is traced into its body, unless the graph has that unit already.
template <class Logic>
Trace::uint call(const Operator& what, const hls::FpBits& format, const Trace::uint& a, const Trace::uint& b,
                 Logic&& logic) {
  Graph& graph = TraceRecorder::graph();
  const std::string name = std::string(what.component) + '_' + std::to_string(format.exponent) + '_' +
                           std::to_string(format.fraction);
  const auto known = std::find_if(graph.units().begin(), graph.units().end(),
                                  [&](const auto& unit) { return unit->body.name() == name; });
  std::shared_ptr<const Unit> unit;
  if (known != graph.units().end()) {
    unit = *known;
  } else {
    const int width = width_of(a);
    Graph body(name);
    const TraceRecorder recorder(body);
    const Trace::uint left(body.input("a", width, false));
    const Trace::uint right(body.input("b", width, false));
    body.output(what.result, logic(format, left, right).id());
    unit = std::make_shared<const Unit>(Unit{what.component, what.bits, canonical(body)});
  }
  const std::array<NodeId, 2> operands{a.id(), b.id()};
  return Trace::uint(graph.call(unit, operands));
}

}  // namespace

Trace::uint call_subtract(const hls::FpBits& format, const Trace::uint& a, const Trace::uint& b) {
  return call(
      {"fp_subtract", "difference", format.width()}, format, a, b,
      [](const auto& f, const auto& x, const auto& y) { return hls::fp_logic::subtract<Trace>(f, x, y); });
}

Trace::uint call_multiply(const hls::FpBits& format, const Trace::uint& a, const Trace::uint& b) {
  return call(
      {"fp_multiply", "product", format.width()}, format, a, b,
      [](const auto& f, const auto& x, const auto& y) { return hls::fp_logic::multiply<Trace>(f, x, y); });
}

Trace::uint call_compare(const hls::FpBits& format, const Trace::uint& a, const Trace::uint& b) {
  return call(
      {"fp_compare", "order", format.width()}, format, a, b,
      [](const auto& f, const auto& x, const auto& y) { return hls::fp_logic::compare<Trace>(f, x, y); });
}

Trace::uint call_subtract_rz(const hls::FpBits& format, const Trace::uint& a, const Trace::uint& b) {
  return call(
      {"fp_subtract_rz", "difference", format.width()}, format, a, b,
      [](const auto& f, const auto& x, const auto& y) { return hls::fp_logic::subtract_rz<Trace>(f, x, y); });
}

// Its cost follows from the significands, which differ between e8m7 and e5m10.
Trace::uint call_multiply_rz(const hls::FpBits& format, const Trace::uint& a, const Trace::uint& b) {
  return call(
      {"fp_multiply_rz", "product", format.fraction + 1}, format, a, b,
      [](const auto& f, const auto& x, const auto& y) { return hls::fp_logic::multiply_rz<Trace>(f, x, y); });
}

}  // namespace hitpipe::rtl
