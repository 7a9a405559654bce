// A pipeline as a host function, in any format: built-in formats have an instance of their own in the native
// domain, all others share the one whose widths are known at run time.
#pragma once

#include <cstdint>
#include <type_traits>

#include "hls/box/format.hpp"
#include "hls/box/operand.hpp"
#include "hls/num/domain.hpp"
#include "hls/num/fp.hpp"
#include "hls/num/sized.hpp"
#include "rtl_gen/catalogue/evaluate.hpp"
#include "rtl_gen/catalogue/host_float.hpp"

namespace hitpipe::rtl {

namespace detail {

/// Reads operands in port order. Bits above a port's width are ignored.
template <class Format>
struct OperandReader {
  template <int W, bool S>
  void operator()(const hls::Operand& /*port*/, hls::ap_base<W, S>& field) {
    field = *next++;
  }
  template <bool S, class Word>
  void operator()(const hls::Operand& port, hls::SizedInt<S, Word>& field) {
    field = hls::SizedInt<S, Word>(static_cast<Word>(*next++), port.width);
  }
  template <class D, class F>
  void operator()(const hls::Operand& port, hls::Fp<D, F>& field) {
    field.format = format;
    (*this)(port, field.bits);
  }

  const Format& format;
  const std::int64_t* next;
};

struct ResultWriter {
  template <class Field>
  void operator()(const hls::Result& /*port*/, const Field& field) {
    *next++ = field.to_int64();
  }

  std::int64_t* next;
};

template <class Pipeline, class D, class F>
void run(const F& format, const std::int64_t* operands, std::int64_t* results) {
  using Operands = typename Pipeline::template Operands<D, F>;
  using Results = typename Pipeline::template Results<D, F>;
  Operands in;
  Operands::for_each(format, in, OperandReader<F>{format, operands});
  const Results out = Pipeline::template test<D>(format, in);
  Results::for_each(format, out, ResultWriter{results});
}

// `flatten`: the datapath runs once per test; inlined whole, its values stay in registers. GCC's sanitizers
// take minutes over so large a function.
#ifdef __SANITIZE_ADDRESS__
#define HITPIPE_FLATTEN
#else
#define HITPIPE_FLATTEN [[gnu::flatten]]
#endif

template <class Pipeline, class F>
HITPIPE_FLATTEN void run_built_in(const Format& /*its own*/, const std::int64_t* operands,
                                  std::int64_t* results) {
  run<Pipeline, hls::Native>(F(), operands, results);
}

template <class Pipeline, class F>
HITPIPE_FLATTEN void run_on_float_unit(const Format& /*its own*/, const std::int64_t* operands,
                                       std::int64_t* results) {
  run<Pipeline, HostFloat>(F(), operands, results);
}

template <class Pipeline>
HITPIPE_FLATTEN void run_any(const Format& format, const std::int64_t* operands, std::int64_t* results) {
  using Domain = std::conditional_t < requires {
    requires Pipeline::wide;
  }
  , hls::WideSized, hls::Sized > ;
  run<Pipeline, Domain>(format.as<typename Pipeline::Bits>(), operands, results);
}
#undef HITPIPE_FLATTEN

}  // namespace detail

/// The fastest bit-level host function for a format; call it with that format.
template <class Pipeline>
Evaluate::Run native_function(const typename Pipeline::Bits& format) {
  Evaluate::Run found = detail::run_any<Pipeline>;
  const auto choose = [&]<class... F>(hls::FormatList<F...>) {
    ((format == F::bits ? void(found = detail::run_built_in<Pipeline, F>) : void()), ...);
  };
  choose(typename Pipeline::BuiltIn());
  return found;
}

/// The same with float operators by the host's floating-point unit, which rounds to nearest. Null when the
/// pipeline does not, or the host has no such numbers.
template <class Pipeline>
Evaluate::Run float_unit_function([[maybe_unused]] const typename Pipeline::Bits& format) {
  Evaluate::Run found = nullptr;
  const auto choose_one = [&]<class F>(F) {
    if constexpr (host_format<F> && requires { requires Pipeline::rounds_to_nearest; }) {
      if (format == F::bits) found = detail::run_on_float_unit<Pipeline, F>;
    }
  };
  const auto choose = [&]<class... F>(hls::FormatList<F...>) { (choose_one(F()), ...); };
  choose(typename Pipeline::BuiltIn());
  return found;
}

}  // namespace hitpipe::rtl
