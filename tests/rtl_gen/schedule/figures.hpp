// What a test compares with the thesis's figures: latches by boundary, components by name.
#pragma once

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "rtl_gen/pipeline.hpp"

namespace hitpipe::rtl {

/// "3 x 24, 1 x 1" for each boundary.
inline std::vector<std::string> latches_by_boundary(const Pipeline& p) {
  std::vector<std::map<int, int, std::greater<>>> counts(static_cast<std::size_t>(p.schedule.stages) + 1);
  for (const Register& r : p.placement.registers) ++counts[static_cast<std::size_t>(r.boundary)][r.width()];
  std::vector<std::string> text;
  for (const auto& widths : counts) {
    text.emplace_back();
    for (const auto& [width, count] : widths) {
      text.back() += fmt::format("{}{} x {}", text.back().empty() ? "" : ", ", count, width);
    }
  }
  return text;
}

/// Latches of a width, and components of a name, over the whole pipeline: the rows of Table 7.2. Nodes that
/// compare the same two values are one comparator.
inline std::map<std::string, int> table_7_2(const Pipeline& p) {
  std::map<std::string, int> counts;
  std::set<std::pair<NodeId, NodeId>> compared;
  for (const Register& r : p.placement.registers) ++counts[fmt::format("latch_{}", r.width())];
  for (NodeId id = 0; id < p.graph.size(); ++id) {
    if (!is_component(p.graph[id].op)) continue;
    const Node& n = p.graph[id];
    if (n.op == Op::less && !compared.insert(std::minmax(n.args[0], n.args[1])).second) continue;
    const ComponentUse use = component_of(p.graph, id);
    ++counts[fmt::format("{}_{}", component_name(use.component), use.bits)];
  }
  return counts;
}

inline NodeId node_named(const Graph& graph, std::string_view name) {
  for (NodeId id = 0; id < graph.size(); ++id) {
    if (graph[id].name == name) return id;
  }
  ADD_FAILURE() << "no node is called " << name;
  return 0;
}

inline int times_latched(const Pipeline& p, std::string_view name) {
  int times = 0;
  for (const Register& r : p.placement.registers) times += p.graph[r.value].name == name ? 1 : 0;
  return times;
}

}  // namespace hitpipe::rtl
