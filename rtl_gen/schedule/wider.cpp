#include "rtl_gen/schedule/wider.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <tuple>
#include <utility>
#include <vector>

#include "rtl_gen/component/product.hpp"
#include "rtl_gen/graph/canonical.hpp"
#include "rtl_gen/graph/rewrite.hpp"

namespace hitpipe::rtl {

namespace {

constexpr int least_cut_bits = 3;  ///< each half of a signed operand then has a bit

/// Sums and differences are one family.
Op operation_family(Op op) {
  return op == Op::sub ? Op::add : op;
}

}  // namespace

std::optional<ComponentShape> shape_of_operation(const Graph& graph, NodeId id) {
  const Node& n = graph[id];
  if (n.op != Op::mul && n.op != Op::add && n.op != Op::sub && n.op != Op::less && n.op != Op::equal)
    return std::nullopt;
  const auto [narrow, wide] = std::minmax({graph[n.args[0]].width, graph[n.args[1]].width});
  return ComponentShape{n.op, n.is_signed, wide, narrow};
}

std::optional<ComponentShape> shape_of_both(const ComponentShape& one, const ComponentShape& other) {
  if (operation_family(one.op) != operation_family(other.op) || one.is_signed != other.is_signed)
    return std::nullopt;
  const ComponentShape both{one.op == other.op ? one.op : Op::add, one.is_signed, std::max(one.a, other.a),
                            std::max(one.b, other.b)};
  if (both.op == Op::mul && both.a + both.b > most_value_bits) return std::nullopt;
  return both;
}

Graph widened(const Graph& graph, const std::map<NodeId, ComponentShape>& shapes) {
  return rewrite(graph, [&](Graph& to, NodeId id, const NewOperands& operands) {
    const auto found = shapes.find(id);
    if (found == shapes.end()) return no_node;
    const Node& n = graph[id];
    const ComponentShape& shape = found->second;
    NodeId a = operands[0];
    NodeId b = operands[1];
    if (n.op == Op::mul && to[a].width < to[b].width) std::swap(a, b);
    a = to.extend(a, shape.a, n.is_signed);
    b = to.extend(b, shape.b, n.is_signed);
    const bool inverts = n.op != shape.op;
    const NodeId wide = to.binary(shape.op, inverts ? to.invert(a) : a, b, n.is_signed);
    const NodeId made = to.slice(wide, n.width - 1, 0);
    return inverts ? to.invert(made) : made;
  });
}

Graph with_products_cut(const Graph& graph, const std::set<NodeId>& products) {
  const auto whole = std::make_shared<const ProductPlan>(ProductPlan{.way = ProductPlan::Way::block});
  return canonical(rewrite(graph, [&](Graph& to, NodeId id, const NewOperands& operands) {
    if (!products.contains(id)) return no_node;
    const bool is_signed = graph[id].is_signed;
    NodeId wide = operands[0];
    NodeId narrow = operands[1];
    if (to[wide].width < to[narrow].width) std::swap(wide, narrow);
    const ProductShape shape{to[wide].width, to[narrow].width, is_signed, is_signed};
    if (shape.width_a < least_cut_bits) return no_node;
    // A zero above the low half makes a signed multiplier read it right.
    const ProductPlan plan{.way = ProductPlan::Way::cut_a,
                           .cut = (shape.width_a - (is_signed ? 1 : 0)) / 2,
                           .low = whole,
                           .high = whole};
    return record_product(to, plan, shape, wide, narrow);
  }));
}

namespace {

using Shapes = std::map<NodeId, ComponentShape>;

constexpr std::array families{Op::mul, Op::add, Op::less, Op::equal};

/// The operations of a family, the widest first.
std::vector<std::pair<ComponentShape, NodeId>> by_width(const Graph& graph, Op family) {
  std::vector<std::pair<ComponentShape, NodeId>> operations;
  for (NodeId id = 0; id < graph.size(); ++id) {
    const auto shape = shape_of_operation(graph, id);
    if (shape && operation_family(shape->op) == family) operations.emplace_back(*shape, id);
  }
  const auto width = [](const ComponentShape& s) { return std::tuple(s.is_signed, s.a, s.b); };
  std::stable_sort(operations.begin(), operations.end(),
                   [&](const auto& x, const auto& y) { return width(x.first) > width(y.first); });
  return operations;
}

/// One shape for the widest operations, as many as a component carries out, then the next, and so on. None if
/// the operations have one shape already.
Shapes packed(const Graph& graph, Op family, int interval) {
  const auto operations = by_width(graph, family);
  Shapes shapes;
  std::vector<NodeId> together;
  std::optional<ComponentShape> of_all;
  bool differ = false;
  for (const auto& [own, id] : operations) {
    differ |= own != operations.front().first;
    if (of_all && static_cast<int>(together.size()) < interval)
      of_all = shape_of_both(*of_all, own);
    else
      of_all.reset();
    if (!of_all) {
      together.clear();
      of_all = own;
    }
    together.push_back(id);
    for (const NodeId each : together) shapes[each] = *of_all;
  }
  return differ ? shapes : Shapes{};
}

/// The area of the fewest components that could carry out all operations.
std::int64_t least_components(const Graph& graph, const Library& library, int interval, int clock_ps) {
  Shapes shapes;
  for (const Op family : families) shapes.merge(packed(graph, family, interval));
  const Graph wide = widened(graph, shapes);
  const SharingPrices prices = sharing_prices(wide, library, clock_ps);
  std::set<NodeId> alone;
  for (NodeId id = 0; id < wide.size(); ++id)
    if (is_component(wide[id].op)) alone.insert(id);
  std::int64_t area = 0;
  for (const SharingGroup& kind : kinds_of(wide)) {
    const auto count = static_cast<std::int64_t>(kind.operations.size());
    area += (count + interval - 1) / interval * prices.operation(kind.operations.front());
    for (const NodeId id : kind.operations) alone.erase(id);
  }
  for (const NodeId id : alone) area += prices.operation(id);
  return area;
}

/// The graph with long products cut, the shortest of them first: each number of them that needs less area of
/// components than any smaller number.
std::vector<Graph> cuts_that_need_less(const Graph& graph, const Library& library, int interval,
                                       int clock_ps) {
  std::vector<Graph> cuts;
  if (library.chip() != nullptr) return cuts;  // its products are made of pieces already
  std::int64_t least = least_components(graph, library, interval, clock_ps);
  std::set<NodeId> cut;
  const auto products = by_width(graph, Op::mul);
  for (auto it = products.rbegin(); it != products.rend(); ++it) {
    const auto& [shape, id] = *it;
    if (shape.a < least_cut_bits || 2 * shape.a < 3 * shape.b) continue;
    cut.insert(id);
    Graph tried = with_products_cut(graph, cut);
    const std::int64_t area = least_components(tried, library, interval, clock_ps);
    if (area >= least) continue;
    least = area;
    cuts.push_back(std::move(tried));
  }
  return cuts;
}

}  // namespace

SharedGraph share_widened(const Graph& graph, const Library& library, int interval,
                          std::optional<int> clock_ps) {
  constexpr int longest_wait = 3;  // of an operation, in one step of the last search
  const int clock = schedule_asap(graph, library, clock_ps).clock_ps;
  constexpr std::int64_t none = std::numeric_limits<std::int64_t>::max();
  std::optional<SharedGraph> best;
  std::int64_t least = none;
  /// The area that the graph takes.
  const auto tried = [&](const Graph& next, int wait) {
    if (schedule_asap(next, library).clock_ps > clock) return none;
    const SharingPrices prices = sharing_prices(next, library, clock);
    SharedSchedule shared = share_for_least_area(next, library, interval, prices, clock, wait);
    const std::int64_t area = area_of(next, shared, prices);
    if (area < least) best = {next, std::move(shared)};
    least = std::min(least, area);
    return area;
  };
  const auto try_wider = [&](const Graph& next) {
    std::int64_t so_far = tried(next, 1);
    Shapes shapes;
    for (const Op family : families) {
      const Shapes more = packed(next, family, interval);
      if (more.empty()) continue;
      Shapes all = shapes;
      all.insert(more.begin(), more.end());
      const std::int64_t area = tried(widened(next, all), 1);
      if (area >= so_far) continue;
      so_far = area;
      shapes = std::move(all);
    }
  };
  try_wider(graph);
  for (const Graph& cut : cuts_that_need_less(graph, library, interval, clock)) try_wider(cut);
  (void)tried(Graph(best->graph), longest_wait);
  return std::move(*best);
}

}  // namespace hitpipe::rtl
