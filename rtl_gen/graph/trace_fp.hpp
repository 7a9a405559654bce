// Floats in the trace domain: an operator is recorded as one component (a call), with the operator's
// bit-level logic traced inside it. These overloads are preferred to hls/num/fp.hpp's, being made for one
// domain.
#pragma once

#include <array>
#include <memory>
#include <string>

#include "hls/num/fp.hpp"
#include "rtl_gen/graph/canonical.hpp"
#include "rtl_gen/graph/trace.hpp"

namespace hitpipe::rtl {

template <int E, int M>
using FpSignal = hls::Fp<Trace, E, M>;

namespace detail {

/// Calls a unit of two floats; `logic` is traced into its body: (bits, bits) -> Signal<R, false>.
template <int R, int E, int M, class Logic>
Signal<R, false> call_fp(const char* component, const char* result, const FpSignal<E, M>& a,
                         const FpSignal<E, M>& b, Logic&& logic) {
  constexpr int width = FpSignal<E, M>::width;
  Graph body(std::string(component) + '_' + std::to_string(E) + '_' + std::to_string(M));
  {
    const Tracer tracer(body);
    using Bits = typename FpSignal<E, M>::Bits;
    const Bits left = Bits::from(body.input("a", width, false));
    const Bits right = Bits::from(body.input("b", width, false));
    body.output(result, logic(left, right).id());
  }
  const auto unit = std::make_shared<const Unit>(Unit{component, width, canonical(body)});
  const std::array<NodeId, 2> operands{a.bits.id(), b.bits.id()};
  return Signal<R, false>::from(Tracer::graph().call(unit, operands));
}

}  // namespace detail

template <int E, int M>
FpSignal<E, M> fp_sub(const FpSignal<E, M>& a, const FpSignal<E, M>& b) {
  return {detail::call_fp<1 + E + M>("fp_subtract", "difference", a, b, [](const auto& x, const auto& y) {
    return hls::fp_logic::subtract<Trace, E, M>(x, y);
  })};
}

template <int E, int M>
FpSignal<E, M> fp_mul(const FpSignal<E, M>& a, const FpSignal<E, M>& b) {
  return {detail::call_fp<1 + E + M>("fp_multiply", "product", a, b, [](const auto& x, const auto& y) {
    return hls::fp_logic::multiply<Trace, E, M>(x, y);
  })};
}

template <int E, int M>
hls::Order<Trace::bit> fp_compare(const FpSignal<E, M>& a, const FpSignal<E, M>& b) {
  const auto order = detail::call_fp<2>("fp_compare", "order", a, b, [](const auto& x, const auto& y) {
    return hls::fp_logic::compare<Trace, E, M>(x, y);
  });
  return {slice<0, 0>(order), slice<1, 1>(order)};
}

template <int E, int M>
Trace::bit fp_less(const FpSignal<E, M>& a, const FpSignal<E, M>& b) {
  return fp_compare(a, b).less;
}

template <int E, int M>
FpSignal<E, M> as(const char* name, const FpSignal<E, M>& value, const char* file = __builtin_FILE(),
                  unsigned line = __builtin_LINE()) {
  return {as(name, value.bits, file, line)};
}
template <int E, int M>
FpSignal<E, M> as(const char* name, char axis, const FpSignal<E, M>& value,
                  const char* file = __builtin_FILE(), unsigned line = __builtin_LINE()) {
  return {as(name, axis, value.bits, file, line)};
}

}  // namespace hitpipe::rtl
