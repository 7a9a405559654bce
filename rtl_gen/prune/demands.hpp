// What is promised of the operands that a unit will ever be given: which numbers a port can have, which port
// never exceeds which. Numbers are those of the port: two's complement when it is signed, else its bits as
// they are; a float port's are its bit patterns, so that +0.0 .. largest finite is 0 .. 0x7f7fffff.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "rtl_gen/catalogue/port.hpp"

namespace hitpipe::rtl {

/// The port's number lies in one of the intervals; one of a single number is a constant.
struct PortDemand {
  std::string port;
  std::vector<Interval> within;
  int low_zeros = 0;  ///< this many low bits are always 0
  friend bool operator==(const PortDemand&, const PortDemand&) = default;
};

/// lesser <= greater, as a box has min <= max.
struct OrderDemand {
  std::string lesser;
  std::string greater;
  friend bool operator==(const OrderDemand&, const OrderDemand&) = default;
};

struct Demands {
  std::vector<PortDemand> ports{};
  std::vector<OrderDemand> orders{};

  [[nodiscard]] bool empty() const { return ports.empty() && orders.empty(); }
  [[nodiscard]] std::size_t count() const { return ports.size() + orders.size(); }
  /// All but one; ports first, then orders.
  [[nodiscard]] Demands without(std::size_t index) const;
  friend bool operator==(const Demands&, const Demands&) = default;
};

/// What any value of the port's width is, as a number.
[[nodiscard]] Interval all_numbers(const Port& port);
/// From the least to the greatest multiple of 2^low_zeros in the interval, if it has one.
[[nodiscard]] std::optional<Interval> multiples_in(const Interval& interval, int low_zeros);
/// From the least to the greatest number demanded.
[[nodiscard]] Interval hull(const PortDemand& demand);

/// Throws std::invalid_argument, one line, when a demand names no port of these or one twice, has no number
/// or numbers that the port cannot have, has intervals that do not ascend or hold no number of as many low
/// zeros, or orders ports of different kinds or so that no operands are left.
void check_demands(const Demands& demands, const std::vector<Port>& ports);

/// Every operand that `weaker` excludes, `demands` exclude too: judged port by port and order by order.
[[nodiscard]] bool implies(const Demands& demands, const Demands& weaker, const std::vector<Port>& ports);

/// The port's number, sign-extended when signed, is as demanded.
[[nodiscard]] bool meets(const PortDemand& demand, std::int64_t number);
/// The operands, in port order and sign-extended when signed, are as demanded.
[[nodiscard]] bool meets(const Demands& demands, const std::vector<Port>& ports,
                         const std::int64_t* operands);

/// "rinf = 1", "irx in [-5, 5]", "iri_floor in [-9, -1] or [1, 9]", "izmin in [-40, 40], a multiple of 4",
/// "ixmin <= ixmax"; by index as in `without`.
[[nodiscard]] std::string demand_text(const Demands& demands, std::size_t index);
[[nodiscard]] std::string demand_text(const PortDemand& demand);

}  // namespace hitpipe::rtl
