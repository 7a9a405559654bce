#include "rtl_gen/prune/facts.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "rtl_gen/graph/sources.hpp"

namespace hitpipe::rtl {

namespace {

Numbers all_signed(int width) {
  const auto most = static_cast<Number>(ones_below(width) >> 1);
  return {-most - 1, most};
}

}  // namespace

Facts::Facts(int width, Word zeros, Word ones, Numbers number)
    : width_(width), zeros_(zeros), ones_(ones), number_(number) {
  sharpen();
}

/// Known bits bound the number; both ends of its interval must have the known low bits; and all numbers of
/// the interval agree in the bits above the highest one in which its ends differ.
void Facts::sharpen() {
  const Word sign = Word{1} << (width_ - 1);
  const Word least = ones_ | (sign & ~zeros_);
  const Word most = (~zeros_ & ones_below(width_) & ~sign) | (ones_ & sign);
  number_.low = std::max(number_.low, number_of(least, width_));
  number_.high = std::min(number_.high, number_of(most, width_));
  const Word below = ones_below(known_low());
  const Word low = static_cast<Word>(number_.low) + ((ones_ - static_cast<Word>(number_.low)) & below);
  const Word high = static_cast<Word>(number_.high) - ((static_cast<Word>(number_.high) - ones_) & below);
  number_ = {static_cast<Number>(low), static_cast<Number>(high)};
  const Word agreed = ~ones_below(width_of_bits(low ^ high));
  zeros_ |= ~low & agreed & ones_below(width_);
  ones_ |= low & agreed & ones_below(width_);
}

Facts Facts::nothing(int width) {
  return {width, 0, 0, all_signed(width)};
}

Facts Facts::constant(int width, Word pattern) {
  const Number number = number_of(pattern, width);
  return {width, 0, 0, {number, number}};
}

Facts Facts::number(int width, Number low, Number high) {
  const Numbers all = all_signed(width);
  if (low < all.low || high > all.high) return nothing(width);
  return {width, 0, 0, {low, high}};
}

Facts Facts::patterns(int width, Patterns p) {
  // Patterns with the top bit clear and set are not one interval of numbers.
  if ((p.low ^ p.high) >> (width - 1) != 0) return nothing(width);
  return number(width, number_of(p.low, width), number_of(p.high, width));
}

Facts Facts::bits(int width, Word zeros, Word ones) {
  return {width, zeros & ones_below(width), ones & ones_below(width), all_signed(width)};
}

Facts Facts::either(const Facts& a, const Facts& b) {
  return {a.width_,
          a.zeros_ & b.zeros_,
          a.ones_ & b.ones_,
          {std::min(a.number_.low, b.number_.low), std::max(a.number_.high, b.number_.high)}};
}

Facts Facts::both(const Facts& a, const Facts& b) {
  return {a.width_,
          a.zeros_ | b.zeros_,
          a.ones_ | b.ones_,
          {std::max(a.number_.low, b.number_.low), std::min(a.number_.high, b.number_.high)}};
}

Patterns Facts::patterns() const {
  if (number_.low >= 0 || number_.high < 0) {
    return {static_cast<Word>(number_.low) & ones_below(width_),
            static_cast<Word>(number_.high) & ones_below(width_)};
  }
  return {ones_, ~zeros_ & ones_below(width_)};
}

int Facts::signed_width() const {
  const auto bits_of = [](Number n) { return 1 + width_of_bits(static_cast<Word>(n < 0 ? ~n : n)); };
  return std::min(width_, std::max(bits_of(number_.low), bits_of(number_.high)));
}

int Facts::unknown_width() const {
  return width_of_bits(~(zeros_ | ones_) & ones_below(width_));
}

int Facts::known_low() const {
  return low_ones(zeros_ | ones_);
}

int Facts::low_zeros() const {
  return low_ones(zeros_);
}

namespace {

/// Pairs of port nodes that the demands order: lesser, greater.
using Orders = std::set<std::pair<NodeId, NodeId>>;

/// The low bits of a sum or difference are known up to where the bits of both operands are.
Facts known_low_bits(const Facts& a, const Facts& b, Word result_of_ones) {
  const Word mask = ones_below(std::min(a.known_low(), b.known_low()));
  return Facts::bits(a.width(), ~result_of_ones & mask, result_of_ones & mask);
}

Facts sum(const Facts& a, const Facts& b) {
  const Numbers x = a.number();
  const Numbers y = b.number();
  Number low = 0;
  Number high = 0;
  const bool fits =
      !__builtin_add_overflow(x.low, y.low, &low) && !__builtin_add_overflow(x.high, y.high, &high);
  const Facts bounds = fits ? Facts::number(a.width(), low, high) : Facts::nothing(a.width());
  return Facts::both(bounds, known_low_bits(a, b, a.ones() + b.ones()));
}

Facts difference(const Facts& a, const Facts& b) {
  const Numbers x = a.number();
  const Numbers y = b.number();
  Number low = 0;
  Number high = 0;
  const bool fits =
      !__builtin_sub_overflow(x.low, y.high, &low) && !__builtin_sub_overflow(x.high, y.low, &high);
  const Facts bounds = fits ? Facts::number(a.width(), low, high) : Facts::nothing(a.width());
  return Facts::both(bounds, known_low_bits(a, b, a.ones() - b.ones()));
}

/// The product is exact: it is as wide as both operands together.
Facts product_in_range(int width, const Facts& a, const Facts& b, bool is_signed) {
  if (!is_signed) {
    return Facts::patterns(width,
                           {a.patterns().low * b.patterns().low, a.patterns().high * b.patterns().high});
  }
  const Numbers x = a.number();
  const Numbers y = b.number();
  const Number corners[] = {x.low * y.low, x.low * y.high, x.high * y.low, x.high * y.high};
  const auto [least, most] = std::minmax_element(std::begin(corners), std::end(corners));
  return Facts::number(width, *least, *most);
}

Facts product(int width, const Facts& a, const Facts& b, bool is_signed) {
  return Facts::both(product_in_range(width, a, b, is_signed),
                     Facts::bits(width, ones_below(std::min(width, a.low_zeros() + b.low_zeros())), 0));
}

Facts sliced(const Facts& a, int low, int width) {
  const Facts bits = Facts::bits(width, a.zeros() >> low, a.ones() >> low);
  return Facts::both(bits, Facts::number(width, a.number().low >> low, a.number().high >> low));
}

Facts concatenated(int width, const Facts& high, const Facts& low) {
  const int shift = low.width();
  const Facts bits =
      Facts::bits(width, high.zeros() << shift | low.zeros(), high.ones() << shift | low.ones());
  const auto above = [&](Number upper, Word lower) {
    return static_cast<Number>(static_cast<Word>(upper) << shift | lower);
  };
  return Facts::both(bits, Facts::number(width, above(high.number().low, low.patterns().low),
                                         above(high.number().high, low.patterns().high)));
}

Facts extended(const Facts& a, int width, bool is_signed) {
  if (is_signed) {
    const Facts bounds = Facts::number(width, a.number().low, a.number().high);
    return Facts::both(bounds, Facts::bits(width, a.zeros() & ones_below(a.width()) >> 1,
                                           a.ones() & ones_below(a.width()) >> 1));
  }
  const Word above = ~ones_below(a.width());
  return Facts::both(Facts::bits(width, a.zeros() | above, a.ones()), Facts::patterns(width, a.patterns()));
}

Facts less(const Facts& a, const Facts& b, bool is_signed) {
  const bool always = is_signed ? a.number().high < b.number().low : a.patterns().high < b.patterns().low;
  const bool never = is_signed ? a.number().low >= b.number().high : a.patterns().low >= b.patterns().high;
  return always ? Facts::constant(1, 1) : never ? Facts::constant(1, 0) : Facts::nothing(1);
}

Facts equal(const Facts& a, const Facts& b) {
  const bool apart = (a.ones() & b.zeros()) != 0 || (a.zeros() & b.ones()) != 0 ||
                     a.number().high < b.number().low || b.number().high < a.number().low;
  if (apart) return Facts::constant(1, 0);
  const bool same = a.is_constant() && b.is_constant() && a.pattern() == b.pattern();
  return same ? Facts::constant(1, 1) : Facts::nothing(1);
}

class Analysis {
 public:
  Analysis(const Graph& graph, const std::vector<Facts>& ports, Orders orders)
      : graph_(graph), orders_(std::move(orders)) {
    facts_.reserve(graph.size());
    std::size_t next_port = 0;
    for (NodeId id = 0; id < graph.size(); ++id)
      facts_.push_back(graph[id].op == Op::input ? ports[next_port++] : of(graph[id], id));
  }
  [[nodiscard]] std::vector<Facts> take() { return std::move(facts_); }

 private:
  [[nodiscard]] Facts of(const Node& n, NodeId id) const {
    const auto arg = [&](std::size_t i) -> const Facts& { return facts_[n.args[i]]; };
    switch (n.op) {
      case Op::input:
        break;  // given
      case Op::constant:
        return Facts::constant(n.width, n.value);
      case Op::slice:
        return sliced(arg(0), n.low, n.width);
      case Op::concat:
        return concatenated(n.width, arg(0), arg(1));
      case Op::extend:
        return extended(arg(0), n.width, n.is_signed);
      case Op::invert:
        return Facts::both(Facts::bits(n.width, arg(0).ones(), arg(0).zeros()),
                           Facts::number(n.width, ~arg(0).number().high, ~arg(0).number().low));
      case Op::bit_and:
        return Facts::bits(n.width, arg(0).zeros() | arg(1).zeros(), arg(0).ones() & arg(1).ones());
      case Op::bit_or:
        return Facts::bits(n.width, arg(0).zeros() & arg(1).zeros(), arg(0).ones() | arg(1).ones());
      case Op::bit_xor:
        return Facts::bits(n.width, (arg(0).zeros() & arg(1).zeros()) | (arg(0).ones() & arg(1).ones()),
                           (arg(0).zeros() & arg(1).ones()) | (arg(0).ones() & arg(1).zeros()));
      case Op::add:
        return sum(arg(0), arg(1));
      case Op::sub:
        return of_difference(n);
      case Op::mul:
        return product(n.width, arg(0), arg(1), n.is_signed);
      case Op::less:
        if (n.args[0] == n.args[1] || in_order(n.args[1], n.args[0], n.is_signed))
          return Facts::constant(1, 0);
        return less(arg(0), arg(1), n.is_signed);
      case Op::equal:
        return n.args[0] == n.args[1] ? Facts::constant(1, 1) : equal(arg(0), arg(1));
      case Op::mux:
        return of_mux(n);
      case Op::call: {
        std::vector<Facts> operands;
        for (const NodeId operand : n.operands()) operands.push_back(facts_[operand]);
        const Graph& body = graph_.submodule_of(id)->body;
        return Analysis(body, operands, {}).take()[body.outputs().front().node];
      }
    }
    return Facts::nothing(n.width);
  }

  [[nodiscard]] Facts of_difference(const Node& n) const {
    const Facts& a = facts_[n.args[0]];
    const Facts& b = facts_[n.args[1]];
    if (n.args[0] == n.args[1]) return Facts::constant(n.width, 0);
    Number most = 0;
    if (in_order(n.args[1], n.args[0], true) &&
        !__builtin_sub_overflow(a.number().high, b.number().low, &most) &&
        most <= static_cast<Number>(ones_below(n.width) >> 1))
      return Facts::both(difference(a, b), Facts::number(n.width, 0, most));
    return difference(a, b);
  }

  [[nodiscard]] Facts of_mux(const Node& n) const {
    const Facts& select = facts_[n.args[0]];
    const Facts& if_one = facts_[n.args[1]];
    const Facts& if_zero = facts_[n.args[2]];
    if (select.is_constant()) return select.pattern() != 0 ? if_one : if_zero;
    const Facts plain = Facts::either(if_one, if_zero);
    // a < b ? b : a is the greater of two, a < b ? a : b the lesser.
    const Node& order = graph_[n.args[0]];
    if (order.op != Op::less || !order.is_signed) return plain;
    const Numbers a = facts_[n.args[1]].number();
    const Numbers b = facts_[n.args[2]].number();
    if (order.args[0] == n.args[2] && order.args[1] == n.args[1])
      return Facts::both(plain, Facts::number(n.width, std::max(a.low, b.low), std::max(a.high, b.high)));
    if (order.args[0] == n.args[1] && order.args[1] == n.args[2]) {
      return Facts::both(plain, Facts::number(n.width, std::min(a.low, b.low), std::min(a.high, b.high)));
    }
    return plain;
  }

  /// Whether both are ports, perhaps made wider or narrower by wires, and the demands order them.
  [[nodiscard]] bool in_order(NodeId lesser, NodeId greater, bool is_signed) const {
    const auto keeps_number = [&](const Node& n) {
      if (n.op == Op::extend) return n.is_signed == is_signed;
      if (n.op != Op::slice || n.low != 0) return false;
      const Facts& whole = facts_[n.args[0]];
      return is_signed ? whole.signed_width() <= n.width : whole.patterns().high <= ones_below(n.width);
    };
    const auto port_of = [&](NodeId id) {
      while (keeps_number(graph_[id])) id = graph_[id].args[0];
      return id;
    };
    const NodeId port = port_of(lesser);
    return graph_[port].op == Op::input && graph_[port].is_signed == is_signed &&
           orders_.contains({port, port_of(greater)});
  }

  const Graph& graph_;
  Orders orders_;
  std::vector<Facts> facts_;
};

}  // namespace

Facts facts_of(const PortDemand& demand, int width, bool is_signed) {
  const auto of = [&](const Interval& i) {
    return is_signed ? Facts::number(width, i.low, i.high)
                     : Facts::patterns(width, {static_cast<Word>(i.low) & ones_below(width),
                                               static_cast<Word>(i.high) & ones_below(width)});
  };
  Facts facts = of(*multiples_in(demand.within.front(), demand.low_zeros));
  for (const Interval& i : demand.within)
    facts = Facts::either(facts, of(*multiples_in(i, demand.low_zeros)));
  return Facts::both(facts, Facts::bits(width, ones_below(demand.low_zeros), 0));
}

std::vector<Facts> analyse(const Graph& graph, const Demands& demands) {
  std::map<std::string, std::size_t> index;
  std::vector<Facts> ports;
  for (const NodeId id : graph.inputs()) {
    index[graph[id].name] = ports.size();
    ports.push_back(Facts::nothing(graph[id].width));
  }
  for (const PortDemand& demand : demands.ports) {
    const std::size_t port = index.at(demand.port);
    const Node& input = graph[graph.inputs()[port]];
    ports[port] = facts_of(demand, input.width, input.is_signed);
  }
  Orders orders;
  for (const OrderDemand& order : demands.orders) {
    const std::size_t lesser = index.at(order.lesser);
    const std::size_t greater = index.at(order.greater);
    const NodeId node = graph.inputs()[lesser];
    orders.insert({node, graph.inputs()[greater]});
    if (!graph[node].is_signed) continue;
    const auto within = [&](Number low, Number high) { return Facts::number(graph[node].width, low, high); };
    const Numbers below = ports[lesser].number();
    const Numbers above = ports[greater].number();
    ports[lesser] = Facts::both(ports[lesser], within(below.low, std::min(below.high, above.high)));
    ports[greater] = Facts::both(ports[greater], within(std::max(below.low, above.low), above.high));
  }
  return Analysis(graph, ports, orders).take();
}

std::vector<Word> read_bits(const Graph& graph) {
  std::vector<Word> bits(graph.size(), 0);
  const auto read = [&](NodeId source, Word mask) { bits[source] |= mask; };
  for (NodeId id = 0; id < graph.size(); ++id)
    if (is_root(graph[id].op)) for_each_source(graph, id, read);
  for (const Output& out : graph.outputs()) for_each_source_of(graph, out.node, read);
  return bits;
}

}  // namespace hitpipe::rtl
