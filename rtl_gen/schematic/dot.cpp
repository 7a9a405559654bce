#include "rtl_gen/schematic/dot.hpp"

#include <algorithm>
#include <bit>
#include <map>
#include <set>

#include <fmt/format.h>

#include "rtl_gen/graph/sources.hpp"
#include "rtl_gen/verilog/names.hpp"

namespace hitpipe::rtl {

namespace {

std::string symbol(const Graph& graph, NodeId id) {
  switch (graph[id].op) {
    case Op::sub:
      return "label=\"\u2212\" shape=circle fillcolor=\"#cfe3f5\"";
    case Op::add:
      return "label=\"+\" shape=circle fillcolor=\"#cfe3f5\"";
    case Op::mul:
      return "label=\"\u00d7\" shape=circle width=0.55 fillcolor=\"#f6d5a8\"";
    case Op::less:
      return "label=\"<>\" shape=circle fillcolor=\"#d9ecd0\"";
    case Op::equal:
      return "label=\"=\" shape=circle fillcolor=\"#d9ecd0\"";
    case Op::mux:
      return fmt::format("label=\"{}2:1\" shape=trapezium orientation=270 fillcolor=\"#eadcf2\"",
                         graph[id].width == 1 ? "b:" : "");
    case Op::bit_and:
      return "label=\"AND\" shape=box style=\"filled,rounded\"";
    case Op::bit_or:
      return "label=\"OR\" shape=box style=\"filled,rounded\"";
    case Op::bit_xor:
      return "label=\"XOR\" shape=box style=\"filled,rounded\"";
    default:
      return "shape=plaintext fillcolor=white";
  }
}

class Drawing {
 public:
  Drawing(const Pipeline& pipeline, const std::string& title)
      : graph_(pipeline.graph),
        schedule_(pipeline.schedule),
        placement_(pipeline.placement),
        names_(value_names(graph_, placement_, {})) {
    text_ = fmt::format(
        "digraph schematic {{\n"
        "  graph [rankdir=LR label=\"{}\" labelloc=t fontname=\"Helvetica\" fontsize=20 nodesep=0.12 "
        "ranksep=0.5"
        " newrank=true]\n"
        "  node [fontname=\"Helvetica\" fontsize=11 style=filled fillcolor=white height=0.3 width=0.3"
        " margin=\"0.06,0.03\"]\n"
        "  edge [fontname=\"Helvetica\" fontsize=9 arrowsize=0.5 color=\"#555555\"]\n",
        title);
    cluster("inputs", "input latches", 0);
    for (int stage = 1; stage <= schedule_.stages; ++stage) {
      cluster(fmt::format("stage_{}", stage), fmt::format("stage {}", stage), stage);
    }
    for (const Output& out : graph_.outputs()) {
      text_ += fmt::format("  out_{0} [label=\"{0}\" shape=plaintext fontsize=14]\n", out.name);
      connect(out.node, schedule_.stages + 1, fmt::format("out_{}", out.name));
    }
    for (const auto& edge : edges_) text_ += "  " + edge + "\n";
    text_ += "}\n";
  }
  [[nodiscard]] std::string take() { return std::move(text_); }

 private:
  void cluster(const std::string& id, const std::string& label, int stage) {
    text_ += fmt::format(
        "  subgraph cluster_{} {{\n    label=\"{}\"; fontsize=14; style=\"filled,rounded\"; "
        "color=\"#bbbbbb\"; fillcolor=\"{}\"\n",
        id, label, stage % 2 == 0 ? "#f4f4f4" : "#fbfbfb");
    for (NodeId n = 0; n < graph_.size(); ++n) {
      const Node& node = graph_[n];
      if (!is_root(node.op) || schedule_.slots[n].stage != stage) continue;
      if (node.op == Op::input) {
        text_ += fmt::format("    v{} [label=\"{}\" shape=plaintext fillcolor=none]\n", n, node.name);
        continue;
      }
      const int stages = schedule_.slots[n].finish - stage + 1;
      const std::string spans =
          stages > 1 ? fmt::format(" xlabel=\"stages {}-{}\"", stage, schedule_.slots[n].finish) : "";
      text_ += fmt::format("    v{} [{} tooltip=\"{}\"{}]\n", n, symbol(graph_, n), names_[n], spans);
      for (const NodeId arg : node.operands()) connect(arg, stage, fmt::format("v{}", n));
    }
    for (const Register& r : placement_.registers) {
      if (r.boundary != stage) continue;
      const std::string name = node_of(r);
      text_ += fmt::format("    {} [label=\"L:{}\" shape=box fillcolor=\"#ffffff\" tooltip=\"{}\"]\n", name,
                           r.width(), names_[r.value]);
      const bool first = stage == (graph_[r.value].op == Op::input ? 0 : schedule_.slots[r.value].finish);
      const std::string from =
          first ? fmt::format("v{}", r.value) : latched(r.value, r.high, r.low, stage - 1);
      const std::string wire =
          first && graph_[r.value].op != Op::input ? fmt::format(" [label=\"{}\"]", names_[r.value]) : "";
      edges_.push_back(fmt::format("{} -> {}{}", from, name, wire));
    }
    text_ += "  }\n";
  }

  static std::string node_of(const Register& r) {
    return fmt::format("r{}_{}_{}_{}", r.value, r.boundary, r.high, r.low);
  }

  std::string latched(NodeId value, int high, int low, int boundary) const {
    for (const Register& r : placement_.registers) {
      if (r.value == value && r.boundary == boundary && r.low <= low && r.high >= high) return node_of(r);
    }
    return fmt::format("v{}", value);
  }

  void connect(NodeId value, int stage, const std::string& to) {
    const bool inverted = graph_[value].op == Op::invert;
    for_each_source_of(graph_, value, [&](NodeId source, std::uint64_t bits) {
      const int high = 63 - std::countl_zero(bits);
      const int low = std::countr_zero(bits);
      const BitSpan used = used_span(graph_, placement_, source);
      std::string attributes = inverted ? " arrowhead=odot" : "";
      if (high == low && used.width() > 1) {
        attributes += high == graph_[source].width - 1 ? " label=\"sign\" style=dashed"
                                                       : fmt::format(" label=\"[{}]\" style=dashed", high);
      }
      edges_.push_back(fmt::format("{} -> {} [{}]", latched(source, high, low, stage - 1), to, attributes));
    });
  }

  const Graph& graph_;
  const Schedule& schedule_;
  const Placement& placement_;
  std::vector<std::string> names_;
  std::vector<std::string> edges_;
  std::string text_;
};

}  // namespace

std::string to_dot(const Pipeline& pipeline, const std::string& title) {
  return Drawing(pipeline, title).take();
}

}  // namespace hitpipe::rtl
