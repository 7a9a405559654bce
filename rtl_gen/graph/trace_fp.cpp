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
  const auto known = std::find_if(graph.submodules().begin(), graph.submodules().end(),
                                  [&](const auto& unit) { return unit->body.name() == name; });
  std::shared_ptr<const Submodule> unit;
  if (known != graph.submodules().end()) {
    unit = *known;
  } else {
    const int width = width_of(a);
    Graph body(name);
    const TraceRecorder recorder(body);
    const Trace::uint left(body.input("a", width, false));
    const Trace::uint right(body.input("b", width, false));
    body.output(what.result, logic(format, left, right).id());
    unit = std::make_shared<const Submodule>(Submodule{what.component, what.bits, canonical(body)});
  }
  const std::array<NodeId, 2> operands{a.id(), b.id()};
  return Trace::uint(graph.call(unit, operands));
}

using hls::FpBits;
using Bits = Trace::uint;
namespace logic = hls::fp_logic;

}  // namespace

Bits call_subtract(const FpBits& f, const Bits& a, const Bits& b) {
  return call({"fp_subtract", "difference", f.width()}, f, a, b, logic::subtract<Trace, FpBits, Bits>);
}
Bits call_multiply(const FpBits& f, const Bits& a, const Bits& b) {
  return call({"fp_multiply", "product", f.width()}, f, a, b, logic::multiply<Trace, FpBits, Bits>);
}
Bits call_compare(const FpBits& f, const Bits& a, const Bits& b) {
  return call({"fp_compare", "order", f.width()}, f, a, b, logic::compare<Trace, FpBits, Bits>);
}
Bits call_subtract_rz(const FpBits& f, const Bits& a, const Bits& b) {
  return call({"fp_subtract_rz", "difference", f.width()}, f, a, b, logic::subtract_rz<Trace, FpBits, Bits>);
}
// Its cost follows from the significands, which differ between e8m7 and e5m10.
Bits call_multiply_rz(const FpBits& f, const Bits& a, const Bits& b) {
  return call({"fp_multiply_rz", "product", f.fraction + 1}, f, a, b,
              logic::multiply_rz<Trace, FpBits, Bits>);
}

}  // namespace hitpipe::rtl
