#include "sim/fit/guarded_feed.hpp"

#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "sim/feeds/with_step.hpp"

namespace hitpipe::sim {

namespace {

[[noreturn]] void fail(const std::string& found, const std::string& demanded) {
  throw std::out_of_range(fmt::format(
      "operands outside the demands that the unit was fitted to: {}, demanded is {}", found, demanded));
}

}  // namespace

OperandGuard::OperandGuard(const rtl::Demands& demands, const std::vector<rtl::Port>& ports) {
  for (std::size_t i = 0; i < ports.size(); ++i) {
    for (const rtl::PortDemand& demand : demands.ports)
      if (demand.port == ports[i].name) bounds_.push_back({i, demand});
    for (std::size_t j = 0; j < ports.size(); ++j)
      for (const rtl::OrderDemand& order : demands.orders)
        if (order.lesser == ports[i].name && order.greater == ports[j].name) orders_.push_back({i, j, order});
  }
}

void OperandGuard::check(std::span<const std::int64_t> operands) const {
  for (const Bound& bound : bounds_) {
    const std::int64_t number = operands[bound.port];
    if (rtl::meets(bound.demand, number)) continue;
    fail(fmt::format("{} = {}", bound.demand.port, number), rtl::demand_text(bound.demand));
  }
  for (const Order& order : orders_) {
    if (operands[order.lesser] <= operands[order.greater]) continue;
    fail(fmt::format("{} = {} and {} = {}", order.demand.lesser, operands[order.lesser], order.demand.greater,
                     operands[order.greater]),
         fmt::format("{} <= {}", order.demand.lesser, order.demand.greater));
  }
}

std::unique_ptr<SceneFeed> guarded(std::unique_ptr<SceneFeed> feed, const OperandGuard& guard,
                                   std::size_t operand_count) {
  return with_step(std::move(feed), [&guard, operand_count](std::int64_t* operands) {
    guard.check({operands, operand_count});
  });
}

}  // namespace hitpipe::sim
