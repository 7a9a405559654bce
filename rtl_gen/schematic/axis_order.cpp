#include "rtl_gen/schematic/axis_order.hpp"

namespace hitpipe::rtl {

namespace {

constexpr double without_axis = 4.0;

}  // namespace

std::vector<double> axis_order(const Graph& graph, const std::vector<Port>& ports) {
  std::vector<double> places(graph.size(), without_axis);
  for (const NodeId id : graph.inputs()) {
    const std::size_t port = index_of(ports, graph[id].name);
    if (port < ports.size() && ports[port].axis != hls::Axis::none)
      places[id] = static_cast<double>(ports[port].axis);
  }
  for (NodeId id = 0; id < graph.size(); ++id) {
    if (graph[id].op == Op::input) continue;
    double sum = 0.0;
    int count = 0;
    for (const NodeId arg : graph[id].operands()) {
      if (places[arg] == without_axis) continue;
      sum += places[arg];
      ++count;
    }
    if (count > 0) places[id] = sum / count;
  }
  return places;
}

}  // namespace hitpipe::rtl
