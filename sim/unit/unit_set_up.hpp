// What software around a unit must know of the demands that it was cut by.
#pragma once

#include <cstdint>
#include <vector>

#include "rays/world/coarse_axes.hpp"
#include "rtl_gen/emit/unit.hpp"

namespace hitpipe::sim {

/// How the set-up of its rays and boxes rounds.
[[nodiscard]] ref::CoarseAxes coarse_axes(const rtl::Unit& unit);
/// False: its set-up says of every ray that it has no end.
[[nodiscard]] bool takes_ends(const rtl::Unit& unit);

/// Checks operands against a unit's demands. Operands that break a demand would give wrong answers unnoticed.
/// An OperandStep of a feed (sim/software/step_feed.hpp).
class DemandGuard {
 public:
  /// Ignores demands on ports that do not exist; check_demands() finds those.
  DemandGuard(const rtl::Demands& demands, const std::vector<rtl::Port>& ports);

  /// Throws std::out_of_range, one line that names port, number and demand.
  void operator()(const std::int64_t* operands) const;

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

}  // namespace hitpipe::sim
