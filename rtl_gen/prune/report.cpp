#include "rtl_gen/prune/report.hpp"

#include <bit>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rtl_gen/component/library.hpp"
#include "rtl_gen/graph/rewrite.hpp"
#include "rtl_gen/prune/facts.hpp"

namespace hitpipe::rtl {

namespace {

std::string kind_of(const Graph& graph, NodeId id) {
  if (graph[id].op == Op::input) return "port";
  if (!is_component(graph[id].op)) return std::string(op_name(graph[id].op));
  return std::string(component_name(component_of(graph, id).component));
}

/// A name made of the nearest reader that the C++ names; the name of a slice when only the slice is read.
std::string name_from_readers(const Graph& graph, NodeId id,
                              const std::vector<std::vector<NodeId>>& readers) {
  const auto only_reader = [&](NodeId at) { return readers[at].size() == 1 ? readers[at].front() : no_node; };
  if (const NodeId wire = only_reader(id); wire != no_node && graph[wire].op == Op::slice)
    if (!graph[wire].name.empty()) return graph[wire].name;
  NodeId at = id;
  while (graph[at].name.empty() && !readers[at].empty()) at = readers[at].front();
  const std::string& reader = graph[at].name.empty() ? graph.name() : graph[at].name;
  return fmt::format("{}_{}", reader, kind_of(graph, id));
}

}  // namespace

Size size_of(const Graph& graph) {
  Size size;
  const std::vector<Word> read = read_bits(graph);
  for (NodeId id = 0; id < graph.size(); ++id) {
    if (graph[id].op == Op::input) size.bits += count_of_ones(read[id]);
    if (!is_root(graph[id].op) || graph[id].op == Op::input) continue;
    ++size.nodes;
    size.bits += graph[id].width;
    if (!is_component(graph[id].op)) continue;
    const ComponentUse use = component_of(graph, id);
    ++size.components[fmt::format("{}_{}", component_name(use.component), use.bits)];
  }
  return size;
}

std::vector<std::string> PruneReport::dropped_ports() const {
  std::vector<std::string> names;
  for (const PortChange& change : ports)
    if (change.bits_after == 0) names.push_back(change.port);
  return names;
}

std::string cut_text(const Cut& cut) {
  const std::string after =
      cut.bits_after == 0 ? "gone" : fmt::format("{} -> {} bits", cut.bits_before, cut.bits_after);
  return fmt::format("{}: {} {} ({}{}{})", cut.name, cut.kind, after, cut.pass,
                     cut.demands.empty() ? "" : "; ", fmt::join(cut.demands, ", "));
}

std::map<std::string, Named> named_values(const Graph& graph) {
  std::map<std::string, Named> values;
  const std::vector<Word> read = read_bits(graph);
  for (NodeId id = 0; id < graph.size(); ++id) {
    const Node& n = graph[id];
    if (!is_root(n.op)) continue;
    int bits = n.width;
    if (n.op == Op::input) bits = count_of_ones(read[id]);
    if (is_component(n.op)) bits = component_of(graph, id).bits;
    if (bits > 0) values.insert({n.name, {kind_of(graph, id), bits}});
  }
  return values;
}

Graph with_names(const Graph& graph) {
  std::vector<std::vector<NodeId>> readers(graph.size());
  std::set<std::string> taken;
  for (NodeId id = 0; id < graph.size(); ++id) {
    for (const NodeId arg : graph[id].operands()) readers[arg].push_back(id);
    if (is_root(graph[id].op)) taken.insert(graph[id].name);
  }
  return rewrite(graph, [&](Graph& to, NodeId id, const NewOperands& operands) {
    if (!is_root(graph[id].op) || !graph[id].name.empty()) return no_node;
    const NodeId made = record_again(to, graph, id, operands);
    const std::string wish = name_from_readers(graph, id, readers);
    std::string name = wish;
    for (int i = 2; !taken.insert(name).second; ++i) name = fmt::format("{}_{}", wish, i);
    to.annotate(made, name, graph[id].source);
    return made;
  });
}

}  // namespace hitpipe::rtl
