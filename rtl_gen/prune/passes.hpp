// The passes of prune(), each a graph to a graph of the same inputs, outputs and, for operands as demanded,
// values. One file each. What a pass leaves unread, canonical() removes.
#pragma once

#include "rtl_gen/graph/graph.hpp"
#include "rtl_gen/prune/demands.hpp"

namespace hitpipe::rtl {

/// Values that the demands leave one pattern only become constants; comparisons are decide_comparisons'.
[[nodiscard]] Graph fold_constants(const Graph& graph, const Demands& demands);

/// Comparisons with one outcome become constants; a signed x < 0 becomes the sign.
[[nodiscard]] Graph decide_comparisons(const Graph& graph, const Demands& demands);

/// Multiplexers whose select is known, or of equal arms, become an arm; one-bit ones with a constant arm
/// become gates; one behind another on the same select reads its arm.
[[nodiscard]] Graph simplify_muxes(const Graph& graph, const Demands& demands);

/// AND, OR and XOR with constants, with equal and with opposite operands.
[[nodiscard]] Graph simplify_gates(const Graph& graph);

/// Sums and differences with 0, differences of equals, products with 0 and powers of two: wires.
[[nodiscard]] Graph simplify_arithmetic(const Graph& graph);

/// Every value is made in the bits that its numbers need; those above are copies of its sign or constants,
/// those below constants, or one operand's where the other ends in zeros.
[[nodiscard]] Graph narrow(const Graph& graph, const Demands& demands);

/// a op b and b op a are one node where the order does not matter.
[[nodiscard]] Graph share(const Graph& graph);

/// Ports that no output depends on leave, unread bits above those read too: the only pass that changes the
/// interface.
[[nodiscard]] Graph narrow_ports(const Graph& graph, const Demands& demands);

}  // namespace hitpipe::rtl
