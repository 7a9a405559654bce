#include "area_model/count.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "hls/box/int_format.hpp"
#include "rtl_gen/graph/sources.hpp"

namespace hitpipe::area {

namespace {

using rtl::Component;
using rtl::Graph;
using rtl::NodeId;
using rtl::Op;

constexpr std::array<Component, rtl::component_count> table_7_1{
    Component::int_subtract, Component::int_multiply, Component::int_compare,    Component::fp_subtract,
    Component::fp_multiply,  Component::fp_compare,   Component::fp_subtract_rz, Component::fp_multiply_rz,
    Component::latch,        Component::latch_enable, Component::mux2,           Component::gate};

auto rank(const Part& part) {
  const auto row = std::find(table_7_1.begin(), table_7_1.end(), part.component) - table_7_1.begin();
  return std::tuple(part.purpose, row, part.bits, part.by);
}

/// q - p: a subtractor fed by multipliers.
bool is_side_relation(const Graph& graph, NodeId node) {
  if (graph[node].op != Op::sub) return false;
  bool products = true;
  rtl::for_each_source(graph, node,
                       [&](NodeId source, rtl::Word) { products &= graph[source].op == Op::mul; });
  return products;
}

bool compares_side_relation(const Graph& graph, NodeId node) {
  if (graph[node].op != Op::less) return false;
  bool compares = false;
  rtl::for_each_source(graph, node,
                       [&](NodeId source, rtl::Word) { compares |= is_side_relation(graph, source); });
  return compares;
}

class Tally {
 public:
  void add(int stage, const Part& part) { ++counts_[{stage, part}]; }
  [[nodiscard]] std::vector<Count> counts() const {
    std::vector<Count> list;
    for (const auto& [key, n] : counts_) list.push_back({key.second, key.first, n});
    return list;
  }

 private:
  std::map<std::pair<int, Part>, int> counts_;
};

/// One node for each component that no other operation uses: a magnitude comparator counts once, by the first
/// of its two orders.
std::vector<NodeId> components_of(const Graph& graph, const rtl::Schedule& schedule,
                                  const rtl::Binding& binding = {}) {
  std::vector<NodeId> nodes;
  std::set<std::tuple<int, NodeId, NodeId, bool>> compared;
  for (NodeId id = 0; id < graph.size(); ++id) {
    const rtl::Node& n = graph[id];
    if (!is_component(n.op) || binding.shares(id)) continue;
    if (n.op == Op::less) {
      const auto [first, second] = std::minmax(n.args[0], n.args[1]);
      if (!compared.insert({schedule.slots[id].stage, first, second, n.is_signed}).second) continue;
    }
    nodes.push_back(id);
  }
  return nodes;
}

/// Part::by
int narrower_operand(const Graph& graph, NodeId id) {
  if (graph[id].op != Op::mul) return 0;
  const auto [narrower, wider] =
      std::minmax({graph[graph[id].args[0]].width, graph[graph[id].args[1]].width});
  return narrower == wider ? 0 : narrower;
}

Part component_part(const Graph& graph, NodeId id) {
  const rtl::ComponentUse use = component_of(graph, id);
  return {use.component, use.bits, Purpose::datapath, narrower_operand(graph, id)};
}

/// Components that operations share, with the multiplexers and latches of their operands, in the stage of the
/// first operation; and the counter of phases.
void add_shared(Tally& tally, const Graph& graph, const rtl::SharedSchedule& shared,
                const rtl::Placement& placement, Component latch) {
  const auto& [schedule, binding] = shared;
  const rtl::RegisterTable registers(placement, binding.interval);
  for (const auto& [instance, operations] : binding.instances()) {
    int stage = schedule.stages;
    for (const NodeId id : operations) stage = std::min(stage, schedule.slots[id].stage);
    const NodeId first = operations.front();
    tally.add(stage, component_part(graph, first));
    for (std::size_t place = 0; place < graph[first].operands().size(); ++place) {
      if (!is_selected(graph, operations, place)) continue;
      const int bits = graph[graph[first].args[place]].width;
      tally.add(stage, {latch, bits});
      const int values = selected_values(graph, shared, registers, operations, place);
      for (int i = 1; i < values; ++i) tally.add(stage, {Component::mux2, bits});
    }
  }
  if (const int bits = rtl::phase_bits(binding.interval)) tally.add(0, {latch, bits, Purpose::phase});
}

void add_logic(Tally& tally, const Graph& graph, const rtl::Schedule& schedule,
               const rtl::Placement& placement, Component latch, Gates gates,
               const rtl::Binding& binding = {}) {
  for (const rtl::Register& r : placement.registers) {
    const Purpose purpose = r.in_block ? Purpose::block : Purpose::datapath;
    tally.add(r.boundary, {latch, r.width(), purpose});
  }
  for (const NodeId id : components_of(graph, schedule, binding))
    tally.add(schedule.slots[id].stage, component_part(graph, id));
  add_shared(tally, graph, {schedule, binding}, placement, latch);
  if (gates == Gates::left_out) return;
  for (NodeId id = 0; id < graph.size(); ++id) {
    const rtl::Node& n = graph[id];
    if (is_root(n.op) && n.op != Op::input && !is_component(n.op))
      tally.add(schedule.slots[id].stage, {Component::gate, n.width});
  }
}

}  // namespace

std::strong_ordering operator<=>(const Part& a, const Part& b) {
  return rank(a) <=> rank(b);
}

std::string part_name(const Part& part) {
  switch (part.purpose) {
    case Purpose::valid:
      return fmt::format("valid_{}", part.bits);
    case Purpose::tag:
      return fmt::format("tag_{}", part.bits);
    case Purpose::phase:
      return fmt::format("phase_{}", part.bits);
    case Purpose::block:
      return fmt::format("block_latch_{}", part.bits);
    case Purpose::datapath:
      break;
  }
  if (part.by != 0) return fmt::format("{}_{}x{}", component_name(part.component), part.bits, part.by);
  return fmt::format("{}_{}", component_name(part.component), part.bits);
}

int printed_latch_bits(const Graph& graph, const rtl::Register& latch, const Format& format,
                       const rtl::ThesisAccounting& printed) {
  const bool product = printed.products_at_n_bits && graph[latch.value].op == Op::mul;
  return product ? std::min(latch.width(), format.as<hls::IntBits>().coord) : latch.width();
}

int printed_component_bits(const Graph& graph, NodeId node, const Format& format,
                           const rtl::ThesisAccounting& printed) {
  if (printed.side_relations_at_t && (is_side_relation(graph, node) || compares_side_relation(graph, node)))
    return format.as<hls::IntBits>().interval;
  return rtl::component_of(graph, node).bits;
}

std::vector<Count> count_logic(const Graph& graph, const rtl::Schedule& schedule,
                               const rtl::Placement& placement, Gates gates) {
  Tally tally;
  add_logic(tally, graph, schedule, placement, Component::latch, gates);
  return tally.counts();
}

int packed_bits(const Graph& graph, const rtl::SharedSchedule& shared, const rtl::Placement& placement) {
  const rtl::Schedule& schedule = shared.schedule;
  const rtl::Binding& binding = shared.binding;
  std::vector<bool> read_at_once(graph.size());
  for (NodeId id = 0; id < graph.size(); ++id) {
    if (!is_root(graph[id].op) || graph[id].op == Op::input) continue;
    rtl::for_each_source(graph, id, [&](NodeId source, rtl::Word) {
      const rtl::Slot& slot = schedule.slots[source];
      if (!slot.latched && slot.finish == schedule.slots[id].stage) read_at_once[source] = true;
    });
  }
  const auto is_made_here = [&](NodeId value, int boundary) {
    const Op op = graph[value].op;
    return op != Op::input && op != Op::mul && !read_at_once[value] &&
           schedule.slots[value].finish == boundary;
  };
  int bits = 0;
  for (const rtl::Register& r : placement.registers)
    if (!r.in_block && is_made_here(r.value, r.boundary)) bits += r.width();
  // The operands of shared components are latched behind their multiplexers.
  const rtl::RegisterTable registers(placement, binding.interval);
  for (const auto& [instance, operations] : binding.instances())
    for (std::size_t place = 0; place < graph[operations.front()].operands().size(); ++place)
      if (is_selected(graph, operations, place)) bits += graph[graph[operations.front()].args[place]].width;
  return bits;
}

rtl::Component register_of(rtl::FlowControl flow, const rtl::Library& library) {
  return flow == rtl::FlowControl::stall && library.has(Component::latch_enable) ? Component::latch_enable
                                                                                 : Component::latch;
}

std::vector<Count> count_built(const rtl::Pipeline& pipeline, Component latch, Gates gates) {
  Tally tally;
  add_logic(tally, pipeline.graph, pipeline.schedule, pipeline.placement, latch, gates, pipeline.binding);
  for (int boundary = 0; boundary <= pipeline.schedule.stages; ++boundary) {
    tally.add(boundary, {latch, 1, Purpose::valid});
    if (boundary % pipeline.interval() == 0) tally.add(boundary, {latch, tag_bits, Purpose::tag});
  }
  return tally.counts();
}

std::vector<Count> count_printed(const rtl::Pipeline& pipeline, const Format& format,
                                 const rtl::ThesisAccounting& printed) {
  const Graph& graph = pipeline.graph;
  Tally tally;
  for (const rtl::Register& r : pipeline.placement.registers) {
    if (r.boundary == 0 && !printed.input_latches) continue;
    tally.add(r.boundary, {Component::latch, printed_latch_bits(graph, r, format, printed)});
  }
  for (const NodeId id : components_of(graph, pipeline.schedule)) {
    tally.add(pipeline.schedule.slots[id].stage,
              {component_of(graph, id).component, printed_component_bits(graph, id, format, printed)});
  }
  return tally.counts();
}

}  // namespace hitpipe::area
