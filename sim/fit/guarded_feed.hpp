// A feed whose operands are checked before a fitted unit sees them: it would answer wrongly, and in silence,
// where they are not as demanded.
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
  /// Demands on ports that are not there are no concern of it: check_demands() is.
  OperandGuard(const rtl::Demands& demands, const std::vector<rtl::Port>& ports);

  /// Throws std::out_of_range, one line that names port, number and demand. In port order, sign-extended when
  /// signed.
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
