// The passes of prune(), one file each. A pass makes a graph with the same inputs and outputs, and with the
// same values for operands that meet the demands. canonical() then removes what is no longer read.
#pragma once

#include "rtl_gen/graph/graph.hpp"
#include "rtl_gen/prune/demands.hpp"

namespace hitpipe::rtl {

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
/// constants. The bits below are constants, or those of one operand of a sum where the other ends in zeros.
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
