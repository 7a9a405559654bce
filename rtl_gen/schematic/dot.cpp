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

std::string unit_symbol(const std::string& component) {
  if (component == "fp_subtract") return "label=\"\u2212\" shape=circle fillcolor=\"#cfe3f5\"";
  if (component == "fp_multiply") return "label=\"\u00d7\" shape=circle width=0.55 fillcolor=\"#f6d5a8\"";
  if (component == "fp_compare") return "label=\"<>\" shape=circle fillcolor=\"#d9ecd0\"";
  return fmt::format("label=\"{}\" shape=box", component);
}

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
    case Op::call:
      return unit_symbol(graph.unit_of(id)->component);
    default:
      return "shape=plaintext fillcolor=white";
  }
}

/// The base of Whole and Part.
class Drawing {
 public:
  [[nodiscard]] std::string take() { return std::move(text_) + "}\n"; }

 protected:
  /// `spread`: a component of several stages takes as many columns.
  Drawing(const Pipeline& pipeline, const std::string& title, bool spread)
      : spread_(spread),
        graph_(pipeline.graph),
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
  }

  /// Components and gates that start in a stage; stage 0: the ports.
  void write_stage(int stage, const char* indent, bool spans) {
    for (NodeId n = 0; n < graph_.size(); ++n) {
      const Node& node = graph_[n];
      if (!is_root(node.op) || schedule_.slots[n].stage != stage) continue;
      if (node.op == Op::input) {
        text_ += fmt::format("{}v{} [label=\"{}\" shape=plaintext fillcolor=none]\n", indent, n, node.name);
        continue;
      }
      const int last = schedule_.slots[n].finish;
      const std::string note =
          spans && last > stage ? fmt::format(" xlabel=\"stages {}-{}\"", stage, last) : "";
      text_ += fmt::format("{}v{} [{} tooltip=\"{}\"{}]\n", indent, n, symbol(graph_, n), names_[n], note);
      for (const NodeId arg : node.operands()) connect(arg, stage, fmt::format("v{}", n));
    }
  }

  void write_latches(int boundary, const char* indent) {
    for (const Register& r : placement_.registers) {
      if (r.boundary != boundary) continue;
      text_ += fmt::format("{}{} [label=\"L:{}\" shape=box fillcolor=\"#ffffff\" tooltip=\"{}\"]\n", indent,
                           node_of(r), r.width(), names_[r.value]);
      const bool is_input = graph_[r.value].op == Op::input;
      const bool first = boundary == (is_input ? 0 : schedule_.slots[r.value].finish);
      const Slot& slot = schedule_.slots[r.value];
      const int columns = spread_ ? std::max(1, slot.finish - slot.stage) : 1;
      const std::string wire =
          first && !is_input ? fmt::format(" [label=\"{}\" minlen={}]", names_[r.value], columns) : "";
      edges_ +=
          fmt::format("  {} -> {}{}\n",
                      first ? fmt::format("v{}", r.value) : source_of(r.value, r.high, r.low, boundary - 1),
                      node_of(r), wire);
    }
  }

  void write_outputs() {
    for (const Output& out : graph_.outputs()) {
      text_ += fmt::format("  out_{0} [label=\"{0}\" shape=plaintext fontsize=14]\n", out.name);
      connect(out.node, schedule_.stages + 1, fmt::format("out_{}", out.name));
    }
  }

  void write_edges() { text_ += edges_; }

  static std::string node_of(const Register& r) {
    return fmt::format("r{}_{}_{}_{}", r.value, r.boundary, r.high, r.low);
  }

  /// The drawn node that holds these bits of a value: a latch at the boundary, or the node that makes the
  /// value.
  virtual std::string source_of(NodeId value, int high, int low, int boundary) {
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
        attributes += fmt::format(" label=\"{}\" style=dashed", bit_label(source, high));
      }
      edges_ += fmt::format("  {} -> {} [{}]\n", source_of(source, high, low, stage - 1), to, attributes);
    });
  }

  std::string bit_label(NodeId value, int bit) const {
    const Node& n = graph_[value];
    if (n.op == Op::call && graph_.unit_of(value)->component == "fp_compare") return bit == 0 ? "<" : ">";
    return bit == n.width - 1 ? "sign" : fmt::format("[{}]", bit);
  }

  ~Drawing() = default;

  bool spread_;
  const Graph& graph_;
  const Schedule& schedule_;
  const Placement& placement_;
  std::vector<std::string> names_;
  std::string edges_;  // also nodes outside all frames
  std::string text_;
};

/// All stages, each in a frame, with every wire.
class Whole final : public Drawing {
 public:
  Whole(const Pipeline& pipeline, const std::string& title) : Drawing(pipeline, title, false) {
    for (int stage = 0; stage <= schedule_.stages; ++stage) {
      const std::string id = stage == 0 ? "inputs" : fmt::format("stage_{}", stage);
      const std::string label = stage == 0 ? "input latches" : fmt::format("stage {}", stage);
      text_ += fmt::format(
          "  subgraph cluster_{} {{\n    label=\"{}\"; fontsize=14; style=\"filled,rounded\"; "
          "color=\"#bbbbbb\"; fillcolor=\"{}\"\n",
          id, label, stage % 2 == 0 ? "#f4f4f4" : "#fbfbfb");
      write_stage(stage, "    ", true);
      write_latches(stage, "    ");
      text_ += "  }\n";
    }
    write_outputs();
    write_edges();
  }
};

/// Some stages as the thesis draws them. A value from an earlier stage stands by its name at each of its
/// readers, and the latches of one boundary are in one column.
class Part final : public Drawing {
 public:
  Part(const Pipeline& pipeline, const std::string& title, StageRange range)
      : Drawing(pipeline, title, true), entry_(range.first - 1) {
    for (int stage = range.first; stage <= range.last; ++stage) {
      write_stage(stage, "  ", false);
      text_ += fmt::format(
          "  {{ rank=same\n    after_{0} [label=\"stage {0}\" shape=plaintext fontsize=14]\n", stage);
      write_latches(stage, "    ");
      text_ += "  }\n";
      if (stage > range.first)
        edges_ += fmt::format("  after_{} -> after_{} [style=invis]\n", stage - 1, stage);
    }
    if (range.last == schedule_.stages) write_outputs();
    write_edges();
  }

 private:
  std::string source_of(NodeId value, int high, int low, int boundary) override {
    if (boundary != entry_ || schedule_.slots[value].finish > entry_) {
      return Drawing::source_of(value, high, low, boundary);
    }
    const std::string id = fmt::format("in{}", entries_++);
    edges_ += fmt::format("  {} [label=\"{}\" shape=plaintext fillcolor=none]\n", id, names_[value]);
    return id;
  }

  int entry_;
  int entries_ = 0;
};

}  // namespace

std::vector<StageRange> stage_groups(const Pipeline& pipeline) {
  std::set<int> starts{1};
  for (NodeId id = 0; id < pipeline.graph.size(); ++id) {
    if (is_component(pipeline.graph[id].op)) starts.insert(pipeline.schedule.slots[id].stage);
  }
  std::vector<StageRange> groups;
  for (const int first : starts) {
    if (!groups.empty()) groups.back().last = first - 1;
    groups.push_back({first, pipeline.schedule.stages});
  }
  return groups;
}

std::string to_dot(const Pipeline& pipeline, const std::string& title) {
  return Whole(pipeline, title).take();
}

std::string to_dot(const Pipeline& pipeline, const std::string& title, StageRange range) {
  return Part(pipeline, title, range).take();
}

}  // namespace hitpipe::rtl
