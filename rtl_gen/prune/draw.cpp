#include "rtl_gen/prune/draw.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

namespace hitpipe::rtl {

namespace {

using Random = std::mt19937_64;

std::uint64_t below(Random& random, std::uint64_t count) {
  return random() % count;
}

bool coin(Random& random) {
  return below(random, 2) != 0;
}

/// 0 .. most.
std::uint64_t some(Random& random, std::uint64_t most) {
  return most == ~std::uint64_t{0} ? random() : below(random, most + 1);
}

/// Their sum or difference, which fits although `steps` alone may not.
std::int64_t above(std::int64_t from, std::uint64_t steps) {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(from) + steps);
}
std::int64_t beneath(std::int64_t from, std::uint64_t steps) {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(from) - steps);
}

std::uint64_t size_of(const Interval& i) {
  return static_cast<std::uint64_t>(i.high) - static_cast<std::uint64_t>(i.low);
}

std::int64_t number_in(Random& random, const Interval& i) {
  const std::uint64_t size = size_of(i);
  switch (below(random, 8)) {
    case 0:
      return above(i.low, some(random, std::min<std::uint64_t>(size, 2)));
    case 1:
      return beneath(i.high, some(random, std::min<std::uint64_t>(size, 2)));
    case 2:
      return std::clamp(above(-2, some(random, 4)), i.low, i.high);
    case 3: {
      // Of any magnitude.
      const std::uint64_t small = some(random, size >> below(random, 64));
      return std::clamp(coin(random) ? above(0, small) : beneath(0, small), i.low, i.high);
    }
    default:
      return above(i.low, some(random, size));
  }
}

/// The multiples of the demand's unit that one of its intervals holds.
Interval multiples(const PortDemand& wanted, std::size_t interval) {
  return *multiples_in(wanted.within[interval], wanted.low_zeros);
}

std::int64_t number(Random& random, const PortDemand& wanted) {
  const Interval i = multiples(wanted, below(random, wanted.within.size()));
  // Between multiples, so the next below is in the interval too.
  return number_in(random, i) >> wanted.low_zeros << wanted.low_zeros;
}

/// By any magnitude, within the interval that it is in.
std::int64_t moved(Random& random, const PortDemand& wanted, std::int64_t from) {
  std::size_t interval = 0;
  while (from > wanted.within[interval].high) ++interval;
  const Interval i = multiples(wanted, interval);
  const bool up = coin(random);
  const std::uint64_t room = size_of(up ? Interval{from, i.high} : Interval{i.low, from});
  const std::uint64_t step = some(random, room >> below(random, 64)) >> wanted.low_zeros << wanted.low_zeros;
  return up ? above(from, step) : beneath(from, step);
}

// Draws that do not meet the orders are seldom; where nearly all fail, the demands are at odds.
constexpr int most_tries = 100'000;

[[noreturn]] void refuse_demands() {
  throw std::runtime_error(fmt::format("demands: none of {} draws meets all of them", most_tries));
}

void put_in_order(std::int64_t& lesser, std::int64_t& greater) {
  if (lesser > greater) std::swap(lesser, greater);
}

}  // namespace

Draw::Draw(const std::vector<Port>& ports, const Demands& demands) {
  for (const Port& port : ports) {
    const std::size_t i = wanted_.size();
    wanted_.push_back({port.name, {all_numbers(port)}});
    for (const PortDemand& each : demands.ports)
      if (each.port == port.name) wanted_.back() = each;
    if (hull(wanted_[i]).low < hull(wanted_[i]).high) free_.push_back(i);
    for (std::size_t j = 0; j < ports.size() && port.role == hls::Role::plane_low; ++j) {
      const Port& other = ports[j];
      if (other.role == hls::Role::plane_high && other.axis == port.axis && other.box == port.box)
        boxes_.push_back({i, j});
    }
  }
  for (const OrderDemand& each : demands.orders)
    orders_.push_back({index_of(ports, each.lesser), index_of(ports, each.greater)});
}

bool Draw::put_in_order(std::vector<std::int64_t>& operands) const {
  for (const Order& order : orders_) rtl::put_in_order(operands[order.lesser], operands[order.greater]);
  // A later order can undo an earlier one.
  for (const Order& order : orders_)
    if (operands[order.lesser] > operands[order.greater]) return false;
  for (std::size_t i = 0; i < operands.size(); ++i)
    if (!meets(wanted_[i], operands[i])) return false;
  return true;
}

std::vector<std::int64_t> Draw::operator()(Random& random) const {
  for (int tries = 0; tries < most_tries; ++tries) {
    std::vector<std::int64_t> operands;
    for (const PortDemand& wanted : wanted_) operands.push_back(number(random, wanted));
    // Boxes turned inside out are seldom hit.
    if (below(random, 4) != 0) {
      for (const Order& box : boxes_) rtl::put_in_order(operands[box.lesser], operands[box.greater]);
    }
    if (put_in_order(operands)) return operands;
  }
  refuse_demands();
}

std::vector<std::int64_t> Draw::beside(const std::vector<std::int64_t>& operands, Random& random) const {
  for (int tries = 0; tries < most_tries; ++tries) {
    std::vector<std::int64_t> near = operands;
    for (std::uint64_t changes = 1 + below(random, 2); changes > 0 && !free_.empty(); --changes) {
      const std::size_t port = free_[below(random, free_.size())];
      near[port] = coin(random) ? number(random, wanted_[port]) : moved(random, wanted_[port], near[port]);
    }
    if (put_in_order(near)) return near;
  }
  refuse_demands();
}

Vector judged(std::vector<std::int64_t> operands, const Evaluate& evaluate) {
  std::vector<std::int64_t> results(evaluate.result_count());
  evaluate(operands.data(), results.data());
  return {std::move(operands), std::move(results)};
}

DrawVectors::DrawVectors(const std::vector<Port>& ports, const Demands& demands, const Evaluate& evaluate,
                         std::uint64_t seed)
    : draw_(ports, demands), evaluate_(evaluate), random_(seed) {
  for (int tries = 0; tries < 100'000 && last_hit_.empty(); ++tries) static_cast<void>(noted(draw_(random_)));
}

Vector DrawVectors::noted(std::vector<std::int64_t> operands) {
  Vector vector = judged(std::move(operands), evaluate_);
  if (evaluate_.hit(vector.results.data())) last_hit_ = vector.operands;
  return vector;
}

Vector DrawVectors::operator()() {
  beside_ = !beside_ && !last_hit_.empty();
  return noted(beside_ ? draw_.beside(last_hit_, random_) : draw_(random_));
}

}  // namespace hitpipe::rtl
