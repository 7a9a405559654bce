#include "rtl_gen/prune/draw.hpp"

#include <algorithm>
#include <bit>
#include <cfloat>
#include <climits>
#include <cmath>
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

/// The least and greatest operands of the port, of the set-up and of floats, with the numbers beside them.
std::vector<std::int64_t> ends_of(const Port& port, const PortDemand& wanted) {
  std::vector<std::int64_t> candidates;
  const auto add = [&](std::int64_t end) {
    for (const int step : {-1, 0, 1}) candidates.push_back(above(end, static_cast<std::uint64_t>(step)));
  };
  for (const Interval& each : wanted.within) add(each.low), add(each.high);
  if (port.range) add(port.range->low), add(port.range->high);
  if (port.kind == hls::Kind::real) {
    // The patterns of binary32, with the sign in the port's own highest bit.
    for (const std::int64_t magnitude : {0x00000000, 0x00800000, 0x3F800000, 0x7F800000, 0x7FC00000})
      for (const std::int64_t sign : {0, 1}) add(magnitude | sign << (port.width - 1));
  }
  std::vector<std::int64_t> ends;
  for (const std::int64_t each : candidates)
    if (meets(wanted, each)) ends.push_back(each);
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  return ends;
}

/// A zero, an infinity or NaN.
std::int64_t special_float(Random& random, int width) {
  const std::int64_t sign = static_cast<std::int64_t>(below(random, 2)) << (width - 1);
  switch (below(random, 4)) {
    case 0:
      return sign | 0x7F800000;
    case 1:
      return sign | 0x7FC00000;
    default:
      return sign;
  }
}

/// A float's pattern as a number that grows with its value; -0 comes before +0. pattern_of() is the way back.
std::int64_t by_value(std::int64_t pattern, int width) {
  const std::int64_t sign = std::int64_t{1} << (width - 1);
  return (pattern & sign) != 0 ? ~(pattern & (sign - 1)) : pattern;
}
std::int64_t pattern_of(std::int64_t number, int width) {
  return number < 0 ? ~number | std::int64_t{1} << (width - 1) : number;
}

/// The number that a pattern stands for, in a format of 9 to 32 bits with 8 for the exponent.
float real_of(std::int64_t pattern, int width) {
  return std::bit_cast<float>(static_cast<std::uint32_t>(pattern) << (32 - width));
}
std::int64_t bits_of_real(float number, int width) {
  return std::bit_cast<std::uint32_t>(number) >> (32 - width);
}

bool is_direction(hls::Role role) {
  return role == hls::Role::direction || role == hls::Role::inverse || role == hls::Role::inverse_low ||
         role == hls::Role::inverse_high;
}

// Draws that do not meet the orders are seldom; where nearly all fail, the demands are at odds.
constexpr int most_tries = 100'000;

void put_in_order(std::int64_t& lesser, std::int64_t& greater) {
  if (lesser > greater) std::swap(lesser, greater);
}

}  // namespace

Draw::Draw(const std::vector<Port>& ports, const Demands& demands) : ports_(ports) {
  for (const Port& port : ports) {
    const std::size_t i = wanted_.size();
    wanted_.push_back({port.name, {all_numbers(port)}});
    for (const PortDemand& each : demands.ports)
      if (each.port == port.name) wanted_.back() = each;
    ends_.push_back(ends_of(port, wanted_[i]));
    if (hull(wanted_[i]).low < hull(wanted_[i]).high) free_.push_back(i);
    for (std::size_t j = 0; j < ports.size() && port.role == hls::Role::plane_low; ++j) {
      const Port& other = ports[j];
      if (other.role == hls::Role::plane_high && other.axis == port.axis && other.box == port.box)
        boxes_.push_back({i, j});
    }
  }
  for (const OrderDemand& each : demands.orders)
    orders_.push_back({index_of(ports, each.lesser).value(), index_of(ports, each.greater).value()});
}

bool Draw::put_in_order(std::vector<std::int64_t>& operands) const {
  for (const Order& order : orders_) rtl::put_in_order(operands[order.lesser], operands[order.greater]);
  // A later order can undo an earlier one.
  return meets_all(operands);
}

bool Draw::meets_all(const std::vector<std::int64_t>& operands) const {
  for (const Order& order : orders_)
    if (operands[order.lesser] > operands[order.greater]) return false;
  for (std::size_t i = 0; i < operands.size(); ++i)
    if (!meets(wanted_[i], operands[i])) return false;
  return true;
}

template <class Make>
std::vector<std::int64_t> Draw::drawn(const Make& make) const {
  for (int tries = 0; tries < most_tries; ++tries) {
    std::vector<std::int64_t> operands = make();
    if (put_in_order(operands)) return operands;
  }
  throw std::runtime_error(fmt::format("demands: none of {} draws meets all of them", most_tries));
}

template <class Change>
std::vector<std::int64_t> Draw::changed(const std::vector<std::int64_t>& operands, std::uint64_t most_changes,
                                        Random& random, const Change& change) const {
  return drawn([&] {
    std::vector<std::int64_t> near = operands;
    for (std::uint64_t changes = 1 + below(random, most_changes); changes > 0 && !free_.empty(); --changes) {
      const std::size_t port = free_[below(random, free_.size())];
      near[port] = change(near, port);
    }
    return near;
  });
}

std::vector<std::int64_t> Draw::operator()(Random& random) const {
  return drawn([&] {
    std::vector<std::int64_t> operands;
    for (const PortDemand& wanted : wanted_) operands.push_back(number(random, wanted));
    // Boxes turned inside out are seldom hit.
    if (below(random, 4) != 0)
      for (const Order& box : boxes_) rtl::put_in_order(operands[box.lesser], operands[box.greater]);
    return operands;
  });
}

std::vector<std::int64_t> Draw::beside(const std::vector<std::int64_t>& operands, Random& random) const {
  return changed(operands, 2, random, [&](const std::vector<std::int64_t>& near, std::size_t port) {
    return coin(random) ? number(random, wanted_[port]) : moved(random, wanted_[port], near[port]);
  });
}

std::int64_t Draw::corner(const std::vector<std::int64_t>& operands, std::size_t port, Random& random) const {
  const PortDemand& wanted = wanted_[port];
  const bool is_real = ports_[port].kind == hls::Kind::real;
  for (int tries = 0; tries < 16; ++tries) {
    std::int64_t drawn = 0;
    // Drawn one after the other: compilers differ in the order of arguments.
    const auto up_or_down = [&](std::uint64_t step) { return coin(random) ? step : std::uint64_t{0} - step; };
    const std::uint64_t power = std::uint64_t{1}
                                << below(random, static_cast<std::uint64_t>(ports_[port].width));
    switch (below(random, 4)) {
      case 0:
        if (ends_[port].empty()) continue;
        return ends_[port][below(random, ends_[port].size())];
      case 1:
        drawn = is_real ? special_float(random, ports_[port].width)
                        : static_cast<std::int64_t>(below(random, 4)) - 2;
        break;
      case 2:
        if (is_real) {
          drawn = special_float(random, ports_[port].width);
        } else {
          const std::uint64_t step = up_or_down(power);
          drawn = above(coin(random) ? 0 : -1, step);
        }
        break;
      default:
        drawn = operands[below(random, operands.size())];
        if (coin(random)) drawn = above(drawn, up_or_down(power));
    }
    if (meets(wanted, drawn)) return drawn;
  }
  return operands[port];
}

std::vector<std::int64_t> Draw::corners(Random& random) const {
  return drawn([&] {
    std::vector<std::int64_t> operands = (*this)(random);
    for (const std::size_t port : free_)
      if (below(random, 8) != 0) operands[port] = corner(operands, port, random);
    return operands;
  });
}

std::vector<std::int64_t> Draw::scaled(const std::vector<std::int64_t>& operands, Random& random) const {
  std::vector<std::int64_t> scaled = operands;
  for (const bool of_directions : {false, true}) {
    int largest = INT_MIN;
    std::vector<std::size_t> alike;
    for (const std::size_t port : free_) {
      if (ports_[port].kind != hls::Kind::real || is_direction(ports_[port].role) != of_directions) continue;
      const float number = real_of(operands[port], ports_[port].width);
      if (!std::isfinite(number) || number == 0.0F) continue;
      alike.push_back(port);
      largest = std::max(largest, std::ilogb(number));
    }
    if (alike.empty() || below(random, 4) == 0) continue;
    const auto step = static_cast<int>(below(random, 32));
    const int exponent = coin(random) ? FLT_MAX_EXP - step / 4 : FLT_MIN_EXP - step;
    for (const std::size_t port : alike) {
      const int width = ports_[port].width;
      const std::int64_t pattern =
          bits_of_real(std::ldexp(real_of(operands[port], width), exponent - largest), width);
      if (meets(wanted_[port], pattern)) scaled[port] = pattern;
    }
  }
  return meets_all(scaled) ? scaled : operands;
}

std::vector<std::int64_t> Draw::corners_beside(const std::vector<std::int64_t>& operands,
                                               Random& random) const {
  return changed(operands, 4, random, [&](const std::vector<std::int64_t>& near, std::size_t port) {
    return corner(near, port, random);
  });
}

std::int64_t Draw::another(const std::vector<std::int64_t>& operands, std::size_t port,
                           Random& random) const {
  return moved(random, wanted_[port], operands[port]);
}

std::int64_t Draw::one_bit_changed(std::int64_t from, std::size_t port, Random& random) const {
  const auto bit = static_cast<int>(below(random, static_cast<std::uint64_t>(ports_[port].width)));
  // The sign stands for all bits above it.
  const std::uint64_t bits = ~std::uint64_t{0} << bit;
  const bool is_sign = ports_[port].is_signed && bit == ports_[port].width - 1;
  return from ^ static_cast<std::int64_t>(is_sign ? bits : bits & ~(bits << 1));
}

std::int64_t Draw::halfway(std::size_t port, std::int64_t low, std::int64_t high) const {
  const int zeros = wanted_[port].low_zeros;
  const auto middle = [zeros](std::int64_t from, std::int64_t to) {
    const std::uint64_t apart = from < to ? size_of({from, to}) : size_of({to, from});
    const std::uint64_t half = apart / 2 >> zeros << zeros;
    return from < to ? above(from, half) : beneath(from, half);
  };
  const int width = ports_[port].width;
  if (ports_[port].kind != hls::Kind::real) return middle(low, high);
  return pattern_of(middle(by_value(low, width), by_value(high, width)), width);
}

Vector with_results(std::vector<std::int64_t> operands, const Evaluate& evaluate) {
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
  Vector vector = with_results(std::move(operands), evaluate_);
  if (evaluate_.yes(vector.results.data())) last_hit_ = vector.operands;
  return vector;
}

Vector DrawVectors::operator()() {
  beside_ = !beside_ && !last_hit_.empty();
  return noted(beside_ ? draw_.beside(last_hit_, random_) : draw_(random_));
}

}  // namespace hitpipe::rtl
