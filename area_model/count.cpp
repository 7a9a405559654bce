#include "area_model/count.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace hitpipe::area {

namespace {

using rtl::Component;
using rtl::NodeId;

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

/// One node for each component: a magnitude comparator counts once, by the first of its two orders.
std::vector<NodeId> components_of(const rtl::Pipeline& pipeline) {
  const rtl::Graph& graph = pipeline.graph;
  std::vector<NodeId> nodes;
  std::set<std::tuple<int, NodeId, NodeId, bool>> compared;
  for (NodeId id = 0; id < graph.size(); ++id) {
    const rtl::Node& n = graph[id];
    if (!is_component(n.op)) continue;
    if (n.op == rtl::Op::less) {
      const auto [first, second] = std::minmax(n.args[0], n.args[1]);
      if (!compared.insert({pipeline.schedule.slots[id].stage, first, second, n.is_signed}).second) continue;
    }
    nodes.push_back(id);
  }
  return nodes;
}

/// Part::by
int narrower_operand(const rtl::Graph& graph, NodeId id) {
  if (graph[id].op != rtl::Op::mul) return 0;
  const auto [narrower, wider] =
      std::minmax({graph[graph[id].args[0]].width, graph[graph[id].args[1]].width});
  return narrower == wider ? 0 : narrower;
}

}  // namespace

std::vector<Count> count_built(const rtl::Pipeline& pipeline) {
  Tally tally;
  for (const rtl::Register& r : pipeline.placement.registers)
    tally.add(r.boundary, {Component::latch, r.width()});
  for (int boundary = 0; boundary <= pipeline.schedule.stages; ++boundary) {
    tally.add(boundary, {Component::latch, 1, Purpose::valid});
    tally.add(boundary, {Component::latch, tag_bits, Purpose::tag});
  }
  for (const NodeId id : components_of(pipeline)) {
    const rtl::ComponentUse use = component_of(pipeline.graph, id);
    tally.add(pipeline.schedule.slots[id].stage,
              {use.component, use.bits, Purpose::datapath, narrower_operand(pipeline.graph, id)});
  }
  return tally.counts();
}

std::vector<Count> count_printed(const rtl::Pipeline& pipeline, const rtl::Format& format,
                                 const rtl::Printed& printed) {
  const rtl::Graph& graph = pipeline.graph;
  Tally tally;
  for (const rtl::Register& r : pipeline.placement.registers) {
    if (r.boundary == 0 && !printed.input_latches) continue;
    tally.add(r.boundary, {Component::latch, printed_latch_bits(graph, r, format, printed)});
  }
  for (const NodeId id : components_of(pipeline)) {
    tally.add(pipeline.schedule.slots[id].stage,
              {component_of(graph, id).component, printed_component_bits(graph, id, format, printed)});
  }
  return tally.counts();
}

}  // namespace hitpipe::area
