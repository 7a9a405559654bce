// A feed that checks operands against a fitted unit's demands before the unit sees them. Without the check,
// operands that break a demand would give wrong answers unnoticed.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "rtl_gen/prune/demands.hpp"
#include "sim/feed.hpp"

namespace hitpipe::sim {

/// Checks operands against demands, as many times as wanted.
class OperandGuard {
 public:
  /// Ignores demands on ports that do not exist; check_demands() finds those.
  OperandGuard(const rtl::Demands& demands, const std::vector<rtl::Port>& ports);

  /// `operands` are in port order, sign-extended when signed. Throws std::out_of_range, one line that names
  /// port, number and demand.
  void check(std::span<const std::int64_t> operands) const;

 private:
  struct Bound {
    std::size_t port;
    rtl::PortDemand demand;
  };
  struct Order {
    std::size_t lesser, greater;
    rtl::OrderDemand demand;
  };
  std::vector<Bound> bounds_;
  std::vector<Order> orders_;
};

/// The guard must outlive the feed.
[[nodiscard]] std::unique_ptr<SceneFeed> guarded(std::unique_ptr<SceneFeed> feed, const OperandGuard& guard,
                                                 std::size_t operand_count);

}  // namespace hitpipe::sim
