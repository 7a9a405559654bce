// Simplifies the graph of a design under demands. prune() runs these passes in this order, again and again
// until none changes anything; canonical() after each removes what is no longer read:
//   fold_constants       values with one possible pattern      rules.cpp
//   decide_comparisons   comparisons with one outcome
//   simplify_muxes       multiplexers whose choice is known
//   simplify_gates       gates with constant or equal operands
//   simplify_arithmetic  sums and products that are wires
//   narrow               values in the bits that they need     narrow.cpp
//   narrow_units         the insides of float operators
//   share                a op b and b op a                     rules.cpp
// and at the end, once, narrow_ports (narrow.cpp), which alone changes the interface.
//
// A pass makes a graph with the same inputs and outputs, and with the same values for operands that meet the
// demands. The result is scheduled, emitted and priced like any traced graph. docs/fit.md tells what each
// pass may do.
#pragma once

#include "rtl_gen/graph/graph.hpp"
#include "rtl_gen/prune/demands.hpp"
#include "rtl_gen/prune/report.hpp"

namespace hitpipe::rtl {

struct PruneOptions {
  /// What the operands meet in any scene (set_up_demands): demands that say no more leave the graph as it is.
  Demands set_up{};
  /// Without it the `demands` of cuts and `shares` stay empty, which saves one run for each demand.
  bool shares = true;
};

struct Pruned {
  Graph graph;
  PruneReport report;
};

/// The outputs are equal for all operands that meet the demands. Throws as check_demands() does.
[[nodiscard]] Pruned prune(const Graph& traced, const Demands& demands, const PruneOptions& options = {});

/// A value that can have only one pattern becomes a constant. Comparisons are left to decide_comparisons.
[[nodiscard]] Graph fold_constants(const Graph& graph, const Demands& demands);

/// A comparison with one possible outcome becomes a constant. A signed x < 0 becomes the sign bit.
[[nodiscard]] Graph decide_comparisons(const Graph& graph, const Demands& demands);

/// A multiplexer with a known select or with equal arms becomes an arm. A one-bit multiplexer with a constant
/// arm becomes a gate. A multiplexer that feeds another with the same select is replaced by its arm.
[[nodiscard]] Graph simplify_muxes(const Graph& graph, const Demands& demands);

/// AND, OR and XOR of constants, of equal and of opposite operands become wires or constants.
[[nodiscard]] Graph simplify_gates(const Graph& graph);

/// Sums and differences with 0, differences of equal values, and products with 0 or a power of two become
/// wires or constants.
[[nodiscard]] Graph simplify_arithmetic(const Graph& graph);

/// Every value is computed in the bits that its numbers need. The bits above are copies of its sign or
/// constants. The bits below are constants, or bits of one operand of a sum whose other operand ends in
/// zeros.
[[nodiscard]] Graph narrow(const Graph& graph, const Demands& demands);

/// A float operator is simplified inside by what is known of its operands, and gets a name of its own. Its
/// ports and its stages stay. If only wires are left, they replace it.
[[nodiscard]] Graph narrow_units(const Graph& graph, const Demands& demands);

/// a op b and b op a become one node where the order does not matter.
[[nodiscard]] Graph share(const Graph& graph);

/// Removes ports that nothing reads, and the bits of ports above the highest bit that is read. It is the only
/// pass that changes the interface.
[[nodiscard]] Graph narrow_ports(const Graph& graph, const Demands& demands);

/// All passes but narrow_ports, in turn until none changes anything.
[[nodiscard]] Graph simplified(const Graph& graph, const Demands& demands);

}  // namespace hitpipe::rtl
