// Demands on the operands of a unit: which numbers a port may have, and which port may not exceed which. A
// signed port's number is its two's complement, an unsigned port's its plain bits. A float port's number is
// its bit pattern, so +0.0 .. largest finite is 0 .. 0x7f7fffff.
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
  /// All demands but one. The index counts ports first, then orders.
  [[nodiscard]] Demands without(std::size_t index) const;
  friend bool operator==(const Demands&, const Demands&) = default;
};

/// All numbers that the port can have.
[[nodiscard]] Interval all_numbers(const Port& port);
/// From the least to the greatest multiple of 2^low_zeros in the interval; none when it holds no multiple.
[[nodiscard]] std::optional<Interval> multiples_in(const Interval& interval, int low_zeros);
/// From the least to the greatest number that the demand allows.
[[nodiscard]] Interval hull(const PortDemand& demand);

/// Throws std::invalid_argument, one line, when a demand names a port that is not among these or that already
/// has a demand; allows no number, or numbers that the port cannot have; has intervals that do not ascend, or
/// one without a number of that many low zeros; orders two ports of different width or sign; or leaves no
/// operands.
void check_demands(const Demands& demands, const std::vector<Port>& ports);

/// Whether `demands` exclude every operand that `weaker` excludes, judged port by port and order by order.
[[nodiscard]] bool implies(const Demands& demands, const Demands& weaker, const std::vector<Port>& ports);

/// Whether the port's number, sign-extended when signed, meets the demand.
[[nodiscard]] bool meets(const PortDemand& demand, std::int64_t number);
/// Whether the operands, in port order and sign-extended when signed, meet the demands.
[[nodiscard]] bool meets(const Demands& demands, const std::vector<Port>& ports,
                         const std::int64_t* operands);

/// "rinf = 1", "irx in [-5, 5]", "iri_floor in [-9, -1] or [1, 9]", "izmin in [-40, 40], a multiple of 4",
/// "ixmin <= ixmax". The index counts as in `without`.
[[nodiscard]] std::string demand_text(const Demands& demands, std::size_t index);
[[nodiscard]] std::string demand_text(const PortDemand& demand);

/// What the set-up of a design meets in any scene: a demand for each port whose range, as its operand states
/// it (hls/box), is narrower than its width. Demands that say no more than these leave the design as it is.
[[nodiscard]] Demands set_up_demands(const std::vector<Port>& ports);

}  // namespace hitpipe::rtl
