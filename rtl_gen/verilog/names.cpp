#include "rtl_gen/verilog/names.hpp"

#include <bit>

#include <fmt/format.h>

#include "rtl_gen/verilog/keywords.hpp"

namespace hitpipe::rtl {

namespace {

/// The name of `value`, or of its nearest reader that the C++ names.
std::string name_downstream(const Graph& graph, NodeId value,
                            const std::vector<std::vector<NodeId>>& readers) {
  for (NodeId at = value;;) {
    if (!graph[at].name.empty()) return graph[at].name;
    if (readers[at].empty()) return graph.name();
    at = readers[at].front();
  }
}

}  // namespace

BitSpan used_span(const Graph& graph, const Placement& placement, NodeId value) {
  const std::uint64_t bits = placement.used_bits[value];
  if (bits == 0) return {graph[value].width - 1, 0};
  return {63 - std::countl_zero(bits), std::countr_zero(bits)};
}

std::vector<std::string> value_names(const Graph& graph, const Placement& placement,
                                     std::set<std::string> taken) {
  const std::set<std::string>& keywords = verilog_keywords();
  taken.insert(keywords.begin(), keywords.end());
  std::vector<std::string> part(graph.size());  // the C++'s name for exactly the used bits
  std::vector<std::vector<NodeId>> readers(graph.size());
  for (NodeId id = 0; id < graph.size(); ++id) {
    const Node& n = graph[id];
    for (const NodeId arg : n.operands()) readers[arg].push_back(id);
    if (n.op != Op::slice || n.name.empty()) continue;
    const BitSpan used = used_span(graph, placement, n.args[0]);
    if (used.low == n.low && used.width() == n.width) part[n.args[0]] = n.name;
  }
  std::vector<std::string> names(graph.size());
  const auto claim = [&](NodeId id, const std::string& wish) {
    std::string name = wish;
    for (int i = 2; !taken.insert(name).second; ++i) name = fmt::format("{}_{}", wish, i);
    names[id] = name;
  };
  // Ports come first, as they must keep their names; then what the C++ names; then the rest.
  for (const NodeId id : graph.inputs()) claim(id, graph[id].name);
  for (const bool named : {true, false}) {
    for (NodeId id = 0; id < graph.size(); ++id) {
      const Node& n = graph[id];
      if (!is_root(n.op) || n.op == Op::input) continue;
      const std::string& own = n.name.empty() ? part[id] : n.name;
      if (own.empty() == named) continue;
      claim(id, named ? own : fmt::format("{}_{}", name_downstream(graph, id, readers), op_name(n.op)));
    }
  }
  return names;
}

}  // namespace hitpipe::rtl
