// The trace domain: the values of a pipeline that record what is done to them. Widths are known at run time.
// Widths and signs follow the rules of hls/num (a + b grows by a bit, and so on), so that the same C++ means
// the same bits here and on the host. Values live while a TraceRecorder is in scope on their thread.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "hls/num/bits.hpp"
#include "rtl_gen/graph/graph.hpp"

namespace hitpipe::rtl {

/// Makes a graph the one that Signals record into, on this thread, until it is destroyed.
class TraceRecorder {
 public:
  explicit TraceRecorder(Graph& graph) : outer_(current_) { current_ = &graph; }
  ~TraceRecorder() { current_ = outer_; }
  TraceRecorder(const TraceRecorder&) = delete;
  TraceRecorder& operator=(const TraceRecorder&) = delete;

  /// Throws std::logic_error when no TraceRecorder is in scope.
  [[nodiscard]] static Graph& graph();

 private:
  static thread_local Graph* current_;
  Graph* outer_;
};

/// A short path, the same on every machine: hls/FOLDER/FILE for a source of the project, FOLDER/FILE for any
/// other.
[[nodiscard]] SourceLine source_line(std::string_view path, unsigned line);

/// Throws std::runtime_error, one line, when a named value comes neither from one of these headers nor from a
/// shared one: hls/num, hls/box or a file *_parts.hpp. Then two designs may define the same function, of
/// which the linker keeps only the other design's.
void check_sources(const Graph& graph, const std::vector<std::string>& headers);

/// Throws std::runtime_error, one line, when a port of a design is wider than programs read and write it.
void check_ports(const Graph& graph);

/// A node of the traced graph, read as two's complement or not. Its width is the node's.
template <bool S>
class Signal {
 public:
  static constexpr bool is_signed = S;

  Signal() = default;
  explicit Signal(NodeId id) : id_(id) {}
  [[nodiscard]] NodeId id() const { return id_; }

 private:
  NodeId id_ = no_node;
};

struct Trace {
  using sint = Signal<true>;
  using uint = Signal<false>;
  using bit = uint;

  static uint lit(std::int64_t value, int width) {
    return uint(TraceRecorder::graph().constant(width, static_cast<Word>(value)));
  }
};

template <bool S>
int width_of(const Signal<S>& x) {
  return TraceRecorder::graph()[x.id()].width;
}

namespace detail {

struct Operand {
  template <bool S>
  Operand(const Signal<S>& signal) : id(signal.id()), is_signed(S) {}
  NodeId id;
  bool is_signed;
};

/// Both operands extended to one width: `growth` bits more than what holds either exactly.
NodeId of_one_width(Op op, Operand a, Operand b, int growth = 0);
NodeId product(Operand a, Operand b);
NodeId less(Operand a, Operand b);

}  // namespace detail

template <bool S1, bool S2>
Signal<S1 || S2> operator+(const Signal<S1>& a, const Signal<S2>& b) {
  return Signal < S1 || S2 > (detail::of_one_width(Op::add, a, b, 1));
}
template <bool S1, bool S2>
Signal<true> operator-(const Signal<S1>& a, const Signal<S2>& b) {
  return Signal<true>(detail::of_one_width(Op::sub, a, b, 1));
}
template <bool S1, bool S2>
Signal<S1 || S2> operator*(const Signal<S1>& a, const Signal<S2>& b) {
  return Signal < S1 || S2 > (detail::product(a, b));
}
template <bool S1, bool S2>
Signal<S1 || S2> operator&(const Signal<S1>& a, const Signal<S2>& b) {
  return Signal < S1 || S2 > (detail::of_one_width(Op::bit_and, a, b));
}
template <bool S1, bool S2>
Signal<S1 || S2> operator|(const Signal<S1>& a, const Signal<S2>& b) {
  return Signal < S1 || S2 > (detail::of_one_width(Op::bit_or, a, b));
}
template <bool S1, bool S2>
Signal<S1 || S2> operator^(const Signal<S1>& a, const Signal<S2>& b) {
  return Signal < S1 || S2 > (detail::of_one_width(Op::bit_xor, a, b));
}
template <bool S>
Signal<S> operator~(const Signal<S>& a) {
  return Signal<S>(TraceRecorder::graph().invert(a.id()));
}

template <bool S1, bool S2>
Trace::bit operator<(const Signal<S1>& a, const Signal<S2>& b) {
  return Trace::bit(detail::less(a, b));
}
template <bool S1, bool S2>
Trace::bit operator>(const Signal<S1>& a, const Signal<S2>& b) {
  return b < a;
}
template <bool S1, bool S2>
Trace::bit operator<=(const Signal<S1>& a, const Signal<S2>& b) {
  return ~(b < a);
}
template <bool S1, bool S2>
Trace::bit operator>=(const Signal<S1>& a, const Signal<S2>& b) {
  return ~(a < b);
}
template <bool S1, bool S2>
Trace::bit operator==(const Signal<S1>& a, const Signal<S2>& b) {
  return Trace::bit(detail::of_one_width(Op::equal, a, b));
}
template <bool S1, bool S2>
Trace::bit operator!=(const Signal<S1>& a, const Signal<S2>& b) {
  return ~(a == b);
}

template <bool S>
Trace::uint slice(const Signal<S>& x, int high, int low) {
  return Trace::uint(TraceRecorder::graph().slice(x.id(), high, low));
}
template <bool S1, bool S2>
Trace::uint cat(const Signal<S1>& high, const Signal<S2>& low) {
  return Trace::uint(TraceRecorder::graph().concat(high.id(), low.id()));
}
template <bool S>
Signal<S> select(const Trace::bit& choose_a, const Signal<S>& a, const Signal<S>& b) {
  return Signal<S>(TraceRecorder::graph().mux(choose_a.id(), a.id(), b.id()));
}
template <bool S>
Signal<S> resize(const Signal<S>& x, int width) {
  return Signal<S>(TraceRecorder::graph().resize(x.id(), width, S));
}
template <bool S>
Trace::sint as_signed(const Signal<S>& x) {
  return Trace::sint(x.id());
}
template <bool S>
Trace::uint as_unsigned(const Signal<S>& x) {
  return Trace::uint(x.id());
}

// std::source_location is not in clang 14; the compilers' own functions beneath it are.
template <bool S>
Signal<S> as(const char* name, const Signal<S>& x, const char* file = __builtin_FILE(),
             unsigned line = __builtin_LINE()) {
  TraceRecorder::graph().annotate(x.id(), name, source_line(file, line));
  return x;
}
template <bool S>
Signal<S> as(const char* name, char axis, const Signal<S>& x, const char* file = __builtin_FILE(),
             unsigned line = __builtin_LINE()) {
  TraceRecorder::graph().annotate(x.id(), std::string(name) + '_' + axis, source_line(file, line));
  return x;
}

}  // namespace hitpipe::rtl
