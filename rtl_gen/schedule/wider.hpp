// Operations of several widths on one component. A component carries out a narrower operation too: the
// operands are extended, and the low bits of the result are right. So operations that differ in their widths
// can share, where that makes the unit smaller.
#pragma once

#include <compare>
#include <map>
#include <optional>
#include <set>

#include "rtl_gen/schedule/least_area.hpp"

namespace hitpipe::rtl {

/// What a component computes, and of how many bits. The first operand of a product is the wider.
struct ComponentShape {
  Op op = Op::add;
  bool is_signed = false;
  int a = 0;
  int b = 0;

  friend auto operator<=>(const ComponentShape&, const ComponentShape&) = default;
};

/// The component that an operation needs; nothing unless it is a product, sum, difference or comparison.
[[nodiscard]] std::optional<ComponentShape> shape_of_operation(const Graph& graph, NodeId id);

/// The smallest component that carries out what either does; nothing if there is none. A difference is a sum
/// with inverters: a - b is ~(~a + b).
[[nodiscard]] std::optional<ComponentShape> shape_of_both(const ComponentShape& one,
                                                          const ComponentShape& other);

/// The same graph with operations made for the given components, which can carry them out. canonical() would
/// undo it.
[[nodiscard]] Graph widened(const Graph& graph, const std::map<NodeId, ComponentShape>& shapes);

/// The graph with each of these products made of two, of the halves of the wider operand. One or two bits
/// stay whole.
[[nodiscard]] Graph with_products_cut(const Graph& graph, const std::set<NodeId>& products);

struct SharedGraph {
  Graph graph;
  SharedSchedule shared;
};

/// share_for_least_area() of the graph, changed where that makes the area less and the clock no longer. Of
/// each kind of operation the widest get one width, as many as a component carries out in an interval, then
/// the next, and so on. In a library of cells some products may be cut first, so that more components are
/// full.
[[nodiscard]] SharedGraph share_widened(const Graph& graph, const Library& library, int interval,
                                        std::optional<int> clock_ps = std::nullopt);

}  // namespace hitpipe::rtl
