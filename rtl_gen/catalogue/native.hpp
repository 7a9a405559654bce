// A pipeline as a host function: its template run in the native domain.
#pragma once

#include <cstdint>

#include "hls/num/domain.hpp"
#include "rtl_gen/catalogue/evaluate.hpp"
#include "rtl_gen/catalogue/instantiate.hpp"

namespace hitpipe::rtl {

// Judging a design runs its datapath once a test: flat, its values stay in registers. GCC's sanitizers take
// minutes over so large a function.
#ifdef __SANITIZE_ADDRESS__
#define HITPIPE_FLATTEN
#else
#define HITPIPE_FLATTEN [[gnu::flatten]]
#endif

/// `operands` in port order, each sign-extended when its port is signed; bits above a port's width are
/// ignored.
template <class Pipeline, class F>
HITPIPE_FLATTEN void run_native(const Format&, const std::int64_t* operands, std::int64_t* results) {
  using Operands = typename Pipeline::template Operands<hls::Native, F>;
  Operands in;
  Operands::for_each(in, [&](const hls::Operand&, auto& field) { field = *operands++; });
  results[0] = Pipeline::template hit<hls::Native, F>(in).to_bool() ? 1 : 0;
}
#undef HITPIPE_FLATTEN

template <class Pipeline>
struct MakeNative {
  static constexpr hls::Arithmetic arithmetic = Pipeline::arithmetic;
  using Entry = Evaluate::Run;
  template <class F>
  static constexpr Entry entry() {
    return run_native<Pipeline, F>;
  }
};

template <class Pipeline>
Evaluate::Run native(const typename Pipeline::Bits& bits) {
  return for_format<MakeNative<Pipeline>>(bits);
}

}  // namespace hitpipe::rtl
