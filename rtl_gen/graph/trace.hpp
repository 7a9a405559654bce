// The trace domain: the values of a pipeline that record what is done to them.
// Widths and signs follow the rules of hls/num (a + b grows by a bit, and so on), so that the same C++ means
// the same bits here and on the host. Values live while a Tracer is in scope on their thread.
#pragma once

#include <algorithm>
#include <concepts>
#include <string>
#include <string_view>
#include <type_traits>

#include "hls/num/domain.hpp"
#include "rtl_gen/graph/graph.hpp"

namespace hitpipe::rtl {

/// Makes a graph the one that Signals record into, on this thread, until it is destroyed.
class Tracer {
 public:
  explicit Tracer(Graph& graph) : outer_(current_) { current_ = &graph; }
  ~Tracer() { current_ = outer_; }
  Tracer(const Tracer&) = delete;
  Tracer& operator=(const Tracer&) = delete;

  /// Throws std::logic_error when no Tracer is in scope.
  [[nodiscard]] static Graph& graph();

 private:
  static thread_local Graph* current_;
  Graph* outer_;
};

/// A short path, the same on every machine: hls/FOLDER/FILE for a source of the project, FOLDER/FILE for any
/// other.
[[nodiscard]] SourceLine source_line(std::string_view path, unsigned line);

template <int W, bool S>
class Signal {
 public:
  static constexpr int width = W;
  static constexpr bool is_signed = S;

  Signal() = default;
  template <std::integral I>
  explicit Signal(I value) : id_(Tracer::graph().constant(W, static_cast<std::uint64_t>(value))) {}
  /// Another width or sign: extended by the source's sign, or wrapped.
  template <int W2, bool S2>
  requires(W2 != W || S2 != S) Signal(const Signal<W2, S2>& other)
      : id_(Tracer::graph().resize(other.id(), W, S2)) {}

  [[nodiscard]] static Signal from(NodeId id) {
    Signal s;
    s.id_ = id;
    return s;
  }
  [[nodiscard]] NodeId id() const { return id_; }

 private:
  NodeId id_ = no_node;
};

struct Trace {
  template <int W>
  using sint = Signal<W, true>;
  template <int W>
  using uint = Signal<W, false>;
  using bit = Signal<1, false>;
};

namespace detail {

/// Both operands of a W1/S1 op W2/S2 at a width that holds either exactly (AP_INT: e1, e2).
template <int W1, bool S1, int W2, bool S2>
struct Pair {
  static constexpr bool is_signed = S1 || S2;
  static constexpr int width = std::max(W1 + (S2 && !S1 ? 1 : 0), W2 + (S1 && !S2 ? 1 : 0));
};

template <int W, bool S>
NodeId widen(const Signal<W, S>& s, int width) {
  return Tracer::graph().resize(s.id(), width, S);
}

template <Op O, int Grow, bool R, int W1, bool S1, int W2, bool S2>
auto same_width(const Signal<W1, S1>& a, const Signal<W2, S2>& b) {
  constexpr int width = Pair<W1, S1, W2, S2>::width + Grow;
  const NodeId wide_a = widen(a, width);
  return Signal<width, R>::from(Tracer::graph().binary(O, wide_a, widen(b, width)));
}

template <Op O, int W1, bool S1, int W2, bool S2>
Signal<1, false> compare(const Signal<W1, S1>& a, const Signal<W2, S2>& b) {
  using P = Pair<W1, S1, W2, S2>;
  const NodeId wide_a = widen(a, P::width);
  const bool reads_sign = O == Op::less && P::is_signed;
  return Signal<1, false>::from(Tracer::graph().binary(O, wide_a, widen(b, P::width), reads_sign));
}

}  // namespace detail

template <int W1, bool S1, int W2, bool S2>
auto operator+(const Signal<W1, S1>& a, const Signal<W2, S2>& b) {
  return detail::same_width < Op::add, 1, S1 || S2 > (a, b);
}
template <int W1, bool S1, int W2, bool S2>
auto operator-(const Signal<W1, S1>& a, const Signal<W2, S2>& b) {
  return detail::same_width<Op::sub, 1, true>(a, b);
}
template <int W1, bool S1, int W2, bool S2>
auto operator*(const Signal<W1, S1>& a, const Signal<W2, S2>& b) {
  // A multiplier has one sign for both operands; an unsigned one beside a signed one gains a zero bit.
  constexpr bool either = S1 || S2;
  const NodeId left = detail::widen(a, W1 + (either && !S1 ? 1 : 0));
  const NodeId right = detail::widen(b, W2 + (either && !S2 ? 1 : 0));
  const NodeId product = Tracer::graph().binary(Op::mul, left, right, either);
  return Signal<W1 + W2, either>::from(Tracer::graph().slice(product, W1 + W2 - 1, 0));
}
template <int W1, bool S1, int W2, bool S2>
auto operator&(const Signal<W1, S1>& a, const Signal<W2, S2>& b) {
  return detail::same_width < Op::bit_and, 0, S1 || S2 > (a, b);
}
template <int W1, bool S1, int W2, bool S2>
auto operator|(const Signal<W1, S1>& a, const Signal<W2, S2>& b) {
  return detail::same_width < Op::bit_or, 0, S1 || S2 > (a, b);
}
template <int W1, bool S1, int W2, bool S2>
auto operator^(const Signal<W1, S1>& a, const Signal<W2, S2>& b) {
  return detail::same_width < Op::bit_xor, 0, S1 || S2 > (a, b);
}
template <int W, bool S>
Signal<W, S> operator~(const Signal<W, S>& a) {
  return Signal<W, S>::from(Tracer::graph().invert(a.id()));
}

template <int W1, bool S1, int W2, bool S2>
Signal<1, false> operator<(const Signal<W1, S1>& a, const Signal<W2, S2>& b) {
  return detail::compare<Op::less>(a, b);
}
template <int W1, bool S1, int W2, bool S2>
Signal<1, false> operator>(const Signal<W1, S1>& a, const Signal<W2, S2>& b) {
  return b < a;
}
template <int W1, bool S1, int W2, bool S2>
Signal<1, false> operator<=(const Signal<W1, S1>& a, const Signal<W2, S2>& b) {
  return ~(b < a);
}
template <int W1, bool S1, int W2, bool S2>
Signal<1, false> operator>=(const Signal<W1, S1>& a, const Signal<W2, S2>& b) {
  return ~(a < b);
}
template <int W1, bool S1, int W2, bool S2>
Signal<1, false> operator==(const Signal<W1, S1>& a, const Signal<W2, S2>& b) {
  return detail::compare<Op::equal>(a, b);
}
template <int W1, bool S1, int W2, bool S2>
Signal<1, false> operator!=(const Signal<W1, S1>& a, const Signal<W2, S2>& b) {
  return ~(a == b);
}

template <int High, int Low, int W, bool S>
Signal<High - Low + 1, false> slice(const Signal<W, S>& a) {
  static_assert(Low >= 0 && High >= Low && High < W, "slice<High, Low> lies inside the value");
  return Signal<High - Low + 1, false>::from(Tracer::graph().slice(a.id(), High, Low));
}
template <int W1, bool S1, int W2, bool S2>
Signal<W1 + W2, false> cat(const Signal<W1, S1>& high, const Signal<W2, S2>& low) {
  return Signal<W1 + W2, false>::from(Tracer::graph().concat(high.id(), low.id()));
}
template <int W, bool S>
Signal<W, S> select(const Signal<1, false>& choose_a, const Signal<W, S>& a, const Signal<W, S>& b) {
  return Signal<W, S>::from(Tracer::graph().mux(choose_a.id(), a.id(), b.id()));
}
template <int N, int W, bool S>
Signal<N, S> resize(const Signal<W, S>& a) {
  return Signal<N, S>::from(Tracer::graph().resize(a.id(), N, S));
}
// std::source_location is not in clang 14; the compilers' own functions beneath it are.
template <int W, bool S>
const Signal<W, S>& as(const char* name, const Signal<W, S>& value, const char* file = __builtin_FILE(),
                       unsigned line = __builtin_LINE()) {
  Tracer::graph().annotate(value.id(), name, source_line(file, line));
  return value;
}
template <int W, bool S>
const Signal<W, S>& as(const char* name, char axis, const Signal<W, S>& value,
                       const char* file = __builtin_FILE(), unsigned line = __builtin_LINE()) {
  Tracer::graph().annotate(value.id(), std::string(name) + '_' + axis, source_line(file, line));
  return value;
}

}  // namespace hitpipe::rtl
