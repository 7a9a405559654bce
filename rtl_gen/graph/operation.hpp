// What each operation of a graph computes, once for all that run graphs.
#pragma once

#include <array>
#include <span>

#include "hls/num/bits.hpp"
#include "rtl_gen/graph/graph.hpp"

namespace hitpipe::rtl {

/// The output of a unit.
using RunUnit = std::uint64_t (*)(const Unit& unit, std::span<const std::uint64_t> operands);
inline std::uint64_t run_body(const Unit& unit, std::span<const std::uint64_t> operands) {
  return evaluate(unit.body, operands).front();
}

/// Calls use(f): f(a, b, c) gives the value of the node for its operands in the low bits of a word, with any
/// bits above its width.
template <class Use>
void with_operation(const Graph& graph, const Node& n, RunUnit run_unit, Use&& use) {
  using Word = std::uint64_t;
  const auto width = [&](std::size_t i) { return n.args[i] == no_node ? 1 : graph[n.args[i]].width; };
  const auto signed_a = [wa = width(0)](Word a) { return hls::sign_extended(a, wa); };
  const auto signed_b = [wb = width(1)](Word b) { return hls::sign_extended(b, wb); };
  switch (n.op) {
    case Op::input:
      return;
    case Op::constant:
      return use([&](Word, Word, Word) { return n.value; });
    case Op::slice:
      return use([low = n.low](Word a, Word, Word) { return a >> low; });
    case Op::concat:
      return use([wb = width(1)](Word a, Word b, Word) { return a << wb | b; });
    case Op::extend:
      if (!n.is_signed) return use([](Word a, Word, Word) { return a; });
      return use([&](Word a, Word, Word) { return static_cast<Word>(signed_a(a)); });
    case Op::invert:
      return use([](Word a, Word, Word) { return ~a; });
    case Op::bit_and:
      return use([](Word a, Word b, Word) { return a & b; });
    case Op::bit_or:
      return use([](Word a, Word b, Word) { return a | b; });
    case Op::bit_xor:
      return use([](Word a, Word b, Word) { return a ^ b; });
    case Op::add:
      return use([](Word a, Word b, Word) { return a + b; });
    case Op::sub:
      return use([](Word a, Word b, Word) { return a - b; });
    case Op::mul:
      if (!n.is_signed) return use([](Word a, Word b, Word) { return a * b; });
      return use([&](Word a, Word b, Word) {
        return static_cast<Word>(signed_a(a)) * static_cast<Word>(signed_b(b));
      });
    case Op::less:
      if (!n.is_signed) return use([](Word a, Word b, Word) { return Word{a < b}; });
      return use([&](Word a, Word b, Word) { return Word{signed_a(a) < signed_b(b)}; });
    case Op::equal:
      return use([](Word a, Word b, Word) { return Word{a == b}; });
    case Op::mux:
      return use([](Word a, Word b, Word c) { return a != 0 ? b : c; });
    case Op::call:
      return use([&](Word a, Word b, Word c) {
        const std::array operands{a, b, c};
        return run_unit(*graph.units()[static_cast<std::size_t>(n.unit)],
                        std::span(operands).first(n.operands().size()));
      });
  }
}

}  // namespace hitpipe::rtl
