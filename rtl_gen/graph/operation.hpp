// What each operation of a graph computes, once for all that run graphs.
#pragma once

#include <array>
#include <span>

#include "rtl_gen/graph/graph.hpp"

namespace hitpipe::rtl {

/// The output of a unit.
using RunSubmodule = std::uint64_t (*)(const Submodule& unit, std::span<const std::uint64_t> operands);
inline std::uint64_t run_body(const Submodule& unit, std::span<const std::uint64_t> operands) {
  return evaluate(unit.body, operands).front();
}

/// Calls use(f): f(a, b, c) gives the value of the node for its operands in the low bits of a W, which holds
/// all of them, with any bits above its width.
template <class W, class Use>
void with_operation(const Graph& graph, const Node& n, RunSubmodule run_submodule, Use&& use) {
  const auto width = [&](std::size_t i) { return n.args[i] == no_node ? 1 : graph[n.args[i]].width; };
  const auto signed_a = [wa = width(0)](W a) { return number_of(a, wa); };
  const auto signed_b = [wb = width(1)](W b) { return number_of(b, wb); };
  switch (n.op) {
    case Op::input:
      return;
    case Op::constant:
      return use([value = static_cast<W>(n.value)](W, W, W) { return value; });
    case Op::slice:
      return use([low = n.low](W a, W, W) { return a >> low; });
    case Op::concat:
      return use([wb = width(1)](W a, W b, W) { return a << wb | b; });
    case Op::extend:
      if (!n.is_signed) return use([](W a, W, W) { return a; });
      return use([&](W a, W, W) { return static_cast<W>(signed_a(a)); });
    case Op::invert:
      return use([](W a, W, W) { return ~a; });
    case Op::bit_and:
      return use([](W a, W b, W) { return a & b; });
    case Op::bit_or:
      return use([](W a, W b, W) { return a | b; });
    case Op::bit_xor:
      return use([](W a, W b, W) { return a ^ b; });
    case Op::add:
      return use([](W a, W b, W) { return a + b; });
    case Op::sub:
      return use([](W a, W b, W) { return a - b; });
    case Op::mul:
      if (!n.is_signed) return use([](W a, W b, W) { return a * b; });
      return use([&](W a, W b, W) { return static_cast<W>(signed_a(a)) * static_cast<W>(signed_b(b)); });
    case Op::less:
      if (!n.is_signed) return use([](W a, W b, W) { return W{a < b}; });
      return use([&](W a, W b, W) { return W{signed_a(a) < signed_b(b)}; });
    case Op::equal:
      return use([](W a, W b, W) { return W{a == b}; });
    case Op::mux:
      return use([](W a, W b, W c) { return a != 0 ? b : c; });
    case Op::call:
      return use([&](W a, W b, W c) {
        const std::array operands{static_cast<std::uint64_t>(a), static_cast<std::uint64_t>(b),
                                  static_cast<std::uint64_t>(c)};
        return W{run_submodule(*graph.submodules()[static_cast<std::size_t>(n.submodule)],
                               std::span(operands).first(n.operands().size()))};
      });
  }
}

}  // namespace hitpipe::rtl
