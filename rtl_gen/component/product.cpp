#include "rtl_gen/component/product.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include <fmt/format.h>

#include "rtl_gen/graph/canonical.hpp"
#include "rtl_gen/graph/rewrite.hpp"

namespace hitpipe::rtl {

Graph multiplier(const MultiplierShape& shape, std::string_view name) {
  Graph g{std::string(name)};
  const NodeId a = g.input("a", shape.width_a, shape.is_signed);
  const NodeId b = g.input("b", shape.width_b, shape.is_signed);
  const int pieces = shape.in_block ? 1 : shape.stages;
  const int piece = (shape.width_b + pieces - 1) / pieces;

  g.begin_stage(1);
  NodeId sum = no_node;  // of the pieces so far; with `is_signed` its top bit is the sign
  int step = 1;
  for (int low = 0; low < shape.width_b; low += piece, ++step) {
    const int high = std::min(low + piece, shape.width_b) - 1;
    const bool top = high == shape.width_b - 1;
    g.begin_stage(1);
    NodeId factor = g.slice(b, high, low);
    // A lower piece has no sign: a zero bit above it makes a signed multiplier read it so.
    if (shape.is_signed && !top) factor = g.extend(factor, g[factor].width + 1, false);
    NodeId product = g.binary(Op::mul, a, factor, shape.is_signed);
    g.annotate(product, fmt::format("piece_{}", step - 1), {});
    if (sum == no_node) {
      sum = product;
      continue;
    }
    g.begin_stage(step);
    const NodeId carried = g.slice(sum, g[sum].width - 1, low);
    const int width = std::min(std::max(g[carried].width, g[product].width) + 1,
                               shape.width_a + shape.width_b - low);  // the whole product is no wider
    const NodeId added = g.binary(Op::add, g.resize(carried, width, shape.is_signed),
                                  g.resize(product, width, shape.is_signed));
    g.annotate(added, fmt::format("sum_{}", step - 1), {});
    sum = g.concat(added, g.slice(sum, low - 1, 0));
  }
  g.output("p",
           g.slice(g.resize(sum, shape.width_a + shape.width_b, shape.is_signed), shape.high, shape.low));
  return canonical(g);
}

namespace {

using Way = ProductPlan::Way;

struct Halves {
  ProductShape low, high;
};

Halves cut(const ProductShape& s, Way way, int at) {
  if (way == Way::cut_a)
    return {{at, s.width_b, false, s.b_signed}, {s.width_a - at, s.width_b, s.a_signed, s.b_signed}};
  return {{s.width_a, at, s.a_signed, false}, {s.width_a, s.width_b - at, s.a_signed, s.b_signed}};
}

/// The sum of two products needs an adder for the bits of the higher product.
int adder_bits(const ProductShape& whole, int at) {
  return whole.width() - at;
}

class Planner {
 public:
  explicit Planner(const Chip& chip, int interval = 1)
      : chip_(chip), block_luts_(chip.block ? (chip.block->luts + interval - 1) / interval : 0) {}

  const ProductPlan& best(const ProductShape& shape, bool is_whole) {
    const auto key = std::pair(shape, is_whole);
    const auto known = plans_.find(key);
    if (known != plans_.end()) return known->second;
    const ProductPlan plan = find(shape, is_whole);
    return plans_[key] = plan;
  }

 private:
  [[nodiscard]] int cost(const ProductPlan& plan) const { return plan.luts + plan.blocks * block_luts_; }

  [[nodiscard]] ProductPlan rows(const ProductShape& s) const {
    const int narrow = std::min(s.width_a, s.width_b);
    const int wide = std::max(s.width_a, s.width_b);
    return {.way = Way::rows,
            .luts = narrow * chip_.gate_luts(wide) + (narrow - 1) * chip_.carry_luts(wide + 1)};
  }

  /// Where a cut leaves a low piece as wide as a block. The wider the low piece, the shorter the adder.
  [[nodiscard]] std::set<int> cuts(int width) const {
    std::set<int> at;
    for (const int side : {chip_.block->width_a, chip_.block->width_b}) {
      for (const int piece : {side - 1, side})
        if (piece < width) at.insert(piece);
    }
    return at;
  }

  ProductPlan find(const ProductShape& s, bool is_whole) {
    ProductPlan best = rows(s);
    if (!chip_.block) return best;
    if (chip_.block->multiplies(s.width_a, s.a_signed, s.width_b, s.b_signed)) {
      const ProductPlan block{.way = Way::block, .blocks = 1};
      return is_whole || cost(block) <= cost(best) ? block : best;
    }
    for (const Way way : {Way::cut_a, Way::cut_b}) {
      for (const int at : cuts(way == Way::cut_a ? s.width_a : s.width_b)) {
        const Halves halves = cut(s, way, at);
        const ProductPlan& low = this->best(halves.low, false);
        const ProductPlan& high = this->best(halves.high, false);
        ProductPlan plan{.way = way,
                         .cut = at,
                         .blocks = low.blocks + high.blocks,
                         .luts = low.luts + high.luts + chip_.carry_luts(adder_bits(s, at))};
        if (cost(plan) >= cost(best)) continue;
        plan.low = std::make_shared<const ProductPlan>(low);
        plan.high = std::make_shared<const ProductPlan>(high);
        best = std::move(plan);
      }
    }
    return best;
  }

  const Chip& chip_;
  int block_luts_;
  std::map<std::pair<ProductShape, bool>, ProductPlan> plans_;
};

/// A part of a sum: its value times 2^low.
struct Term {
  NodeId node = no_node;
  int low = 0;
  bool is_signed = false;
  bool is_negative = false;  ///< to be subtracted
};

/// The sum modulo 2^width. `upper` begins no lower than `lower`, and `lower` is not subtracted. If only
/// one term has a sign, `upper` has the product's highest bit. Then `width` limits the sum, and a sign bit
/// for the other term would be cut off again.
Term sum_of(Graph& to, const Term& lower, const Term& upper, int width) {
  const int shift = upper.low - lower.low;
  const bool is_signed = lower.is_signed || upper.is_signed || upper.is_negative;
  const int bits =
      std::min(std::max(to[lower.node].width, to[upper.node].width + shift) + 1, width - lower.low);
  const NodeId below = to.resize(lower.node, bits, lower.is_signed);
  const NodeId sum = to.binary(upper.is_negative ? Op::sub : Op::add, to.slice(below, bits - 1, shift),
                               to.resize(upper.node, bits - shift, upper.is_signed));
  return {shift == 0 ? sum : to.concat(sum, to.slice(below, shift - 1, 0)), lower.low, is_signed, false};
}

NodeId rows(Graph& to, const ProductShape& s, NodeId a, NodeId b) {
  const bool b_narrower = s.width_b <= s.width_a;
  const NodeId narrow = b_narrower ? b : a;
  const NodeId wide = b_narrower ? a : b;
  const bool narrow_signed = b_narrower ? s.b_signed : s.a_signed;
  const bool wide_signed = b_narrower ? s.a_signed : s.b_signed;
  const int bits = to[narrow].width;
  const int width = s.width();
  std::vector<Term> terms;
  for (int i = 0; i < bits; ++i) {
    const NodeId bit = to.slice(narrow, i, i);
    const NodeId row = to.binary(Op::bit_and, wide, to.extend(bit, to[wide].width, true));
    terms.push_back({row, i, wide_signed, narrow_signed && i == bits - 1});
  }
  if (terms.size() == 1 && terms.front().is_negative) {
    terms = {sum_of(to, {to.constant(1, 0), 0, false, false}, terms.front(), width)};
  }
  while (terms.size() > 1) {
    std::vector<Term> sums;
    for (std::size_t i = 0; i + 1 < terms.size(); i += 2)
      sums.push_back(sum_of(to, terms[i], terms[i + 1], width));
    if (terms.size() % 2 == 1) sums.push_back(terms.back());
    terms = std::move(sums);
  }
  return to.resize(terms.front().node, width, terms.front().is_signed);
}

NodeId block(Graph& to, const ProductShape& s, NodeId a, NodeId b) {
  const bool is_signed = s.a_signed || s.b_signed;
  const auto operand = [&](NodeId value, bool value_signed) {
    return is_signed && !value_signed ? to.extend(value, to[value].width + 1, false) : value;
  };
  const NodeId product = to.binary(Op::mul, operand(a, s.a_signed), operand(b, s.b_signed), is_signed);
  return to.slice(product, s.width() - 1, 0);
}

/// a * {high, low} of unsigned numbers, as the source writes it for cells: two products, and their sum
/// without the low bits.
struct HalvedProduct {
  NodeId a = no_node, high = no_node, low = no_node;
};

/// What x + y multiplies, if that is such a sum: x is the product of the high half.
std::optional<HalvedProduct> halved_product(const Graph& graph, NodeId x, NodeId y) {
  const Node& extended = graph[y];
  if (graph[x].op != Op::mul || graph[x].is_signed || extended.op != Op::extend || extended.is_signed)
    return std::nullopt;
  const Node& upper = graph[extended.args[0]];
  if (upper.op != Op::slice) return std::nullopt;
  const Node& of_low = graph[upper.args[0]];
  if (of_low.op != Op::mul || of_low.is_signed || upper.low + upper.width != of_low.width)
    return std::nullopt;
  for (const NodeId a : graph[x].operands()) {
    const NodeId high = graph[x].args[a == graph[x].args[0] ? 1 : 0];
    for (const int other : {0, 1}) {
      const NodeId low = of_low.args[static_cast<std::size_t>(other)];
      if (of_low.args[static_cast<std::size_t>(1 - other)] == a && graph[low].width == upper.low)
        return HalvedProduct{a, high, low};
    }
  }
  return std::nullopt;
}

/// The graph with one product for two halves where a block multiplies the whole.
Graph with_halves_joined(const Graph& graph, const Block& block) {
  return canonical(rewrite(graph, [&](Graph& to, NodeId id, const NewOperands& operands) {
    if (graph[id].op != Op::add) return no_node;
    std::optional<HalvedProduct> found = halved_product(to, operands[0], operands[1]);
    if (!found) found = halved_product(to, operands[1], operands[0]);
    if (!found) return no_node;
    const NodeId b = to.concat(found->high, found->low);
    if (!block.multiplies(to[found->a].width, false, to[b].width, false)) return no_node;
    const NodeId product = to.binary(Op::mul, found->a, b);
    const int low = to[found->low].width;
    return to.slice(product, low + graph[id].width - 1, low);
  }));
}

}  // namespace

ProductPlan plan_product(const ProductShape& shape, const Chip& chip) {
  return Planner(chip).best(shape, true);
}

NodeId record_product(Graph& to, const ProductPlan& plan, const ProductShape& shape, NodeId a, NodeId b) {
  switch (plan.way) {
    case Way::block:
      return block(to, shape, a, b);
    case Way::rows:
      return rows(to, shape, a, b);
    case Way::cut_a:
    case Way::cut_b:
      break;
  }
  const bool of_a = plan.way == Way::cut_a;
  const Halves halves = cut(shape, plan.way, plan.cut);
  const NodeId divided = of_a ? a : b;
  const NodeId low_bits = to.slice(divided, plan.cut - 1, 0);
  const NodeId high_bits = to.slice(divided, to[divided].width - 1, plan.cut);
  const NodeId low = record_product(to, *plan.low, halves.low, of_a ? low_bits : a, of_a ? b : low_bits);
  const NodeId high = record_product(to, *plan.high, halves.high, of_a ? high_bits : a, of_a ? b : high_bits);
  const Term sum = sum_of(to, {low, 0, halves.low.a_signed || halves.low.b_signed, false},
                          {high, plan.cut, shape.a_signed || shape.b_signed, false}, shape.width());
  return to.resize(sum.node, shape.width(), sum.is_signed);
}

Graph with_products_planned(const Graph& graph, const Library& library, int interval) {
  const Chip* const chip = library.chip();
  if (chip == nullptr) return graph;
  Planner planner(*chip, interval);
  const Graph joined = chip->block ? with_halves_joined(graph, *chip->block) : graph;
  return canonical(rewrite(joined, [&](Graph& to, NodeId id, const NewOperands& operands) {
    const Node& n = joined[id];
    if (n.op != Op::mul) return no_node;
    const ProductShape shape{joined[n.args[0]].width, joined[n.args[1]].width, n.is_signed, n.is_signed};
    return record_product(to, planner.best(shape, true), shape, operands[0], operands[1]);
  }));
}

}  // namespace hitpipe::rtl
