#include "tests/sim/vectors/fault_simulation.hpp"

#include <algorithm>
#include <bit>
#include <span>

#include "tests/sim/vectors/float_units.hpp"

namespace hitpipe::sim {

using rtl::Lanes;
using rtl::most_lanes;
using rtl::NodeId;

namespace {

rtl::Word float_result(const rtl::Submodule& unit, std::span<const std::uint64_t> operands) {
  switch (fp::operator_of(unit)) {
    case fp::Operator::subtract:
      return fp::subtract(operands[0], operands[1]);
    case fp::Operator::multiply:
      return fp::multiply(operands[0], operands[1]);
    case fp::Operator::subtract_rz:
      return fp::subtract_rz(fp::format_of(unit), operands[0], operands[1]);
    case fp::Operator::multiply_rz:
      return fp::multiply_rz(fp::format_of(unit), operands[0], operands[1]);
    default:
      return fp::compare(operands[0], operands[1]);
  }
}

std::uint64_t run_float(const rtl::Submodule& unit, std::span<const std::uint64_t> operands) {
  return static_cast<std::uint64_t>(float_result(unit, operands));
}

Lanes wrong_values(const rtl::Graph& graph, const rtl::GraphLanes& batch, const Fault& fault) {
  const rtl::Node& node = graph[fault.node];
  const Lanes none{};
  const auto operand = [&](std::size_t i) -> const Lanes& {
    return node.args[i] == rtl::no_node ? none : batch.right(node.args[i]);
  };
  const auto width = [&](std::size_t i) {
    return node.args[i] == rtl::no_node ? 0 : graph[node.args[i]].width;
  };
  Lanes wrong;
  for (std::size_t i = 0; i < most_lanes; ++i) {
    const Site site{
        node,     operand(0)[i], operand(1)[i], operand(2)[i], width(0), width(1), batch.right(fault.node)[i],
        fault.bit};
    wrong[i] = fault.wrong(site) & rtl::ones_below(node.width);
  }
  return wrong;
}

}  // namespace

FaultSimulation::FaultSimulation(const rtl::Graph& graph,
                                 const std::vector<std::vector<std::int64_t>>& operands)
    : graph_(graph) {
  const std::span<const std::vector<std::int64_t>> all(operands);
  const rtl::GraphLanes empty(graph, run_float);
  for (std::size_t first = 0; first < all.size(); first += most_lanes) {
    batches_.push_back(empty);
    batches_.back().load(all.subspan(first, std::min(most_lanes, all.size() - first)));
  }
}

std::vector<std::uint64_t> FaultSimulation::outputs(std::size_t vector) const {
  std::vector<std::uint64_t> all;
  for (const rtl::Output& out : graph_.outputs())
    all.push_back(
        static_cast<std::uint64_t>(batches_[vector / most_lanes].right(out.node)[vector % most_lanes]));
  return all;
}

std::optional<std::size_t> FaultSimulation::shown_by(const Fault& fault) {
  for (std::size_t i = 0; i < batches_.size(); ++i) {
    const std::uint64_t shown = batches_[i].shown_by(fault.node, wrong_values(graph_, batches_[i], fault));
    if (shown != 0) return i * most_lanes + static_cast<std::size_t>(std::countr_zero(shown));
  }
  return std::nullopt;
}

}  // namespace hitpipe::sim
