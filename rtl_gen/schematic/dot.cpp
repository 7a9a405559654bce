#include "rtl_gen/schematic/dot.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <set>

#include <fmt/format.h>

#include "hls/num/bits.hpp"
#include "rtl_gen/graph/sources.hpp"
#include "rtl_gen/verilog/names.hpp"

namespace hitpipe::rtl {

namespace {

constexpr double without_axis = 4.0;

}  // namespace

std::vector<double> axis_order(const Graph& graph, const std::vector<Port>& ports) {
  std::vector<double> places(graph.size(), without_axis);
  for (const NodeId id : graph.inputs()) {
    const auto port = index_of(ports, graph[id].name);
    if (port && ports[*port].axis != hls::Axis::none) places[id] = static_cast<double>(ports[*port].axis);
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

namespace {

constexpr const char* difference_style = "label=\"\u2212\" shape=circle fillcolor=\"#cfe3f5\"";
constexpr const char* product_style = "label=\"\u00d7\" shape=circle width=0.55 fillcolor=\"#f6d5a8\"";

std::string comparator(std::string_view sign) {
  return fmt::format("label=\"{}\" shape=circle fillcolor=\"#d9ecd0\"", sign);
}

/// The arms are named by the value of the select input, which is the lowest of the three.
std::string multiplexer(int width, bool one_above) {
  const std::string_view row = "<tr><td port=\"{0}\">{0}</td>{1}</tr>";
  const std::string label = fmt::format("<td rowspan=\"3\">{}2:1</td>", width == 1 ? "b:" : "");
  return fmt::format(
      "shape=plain style=\"\" label=<<table border=\"1\" cellborder=\"0\" cellspacing=\"0\" "
      "cellpadding=\"2\" "
      "bgcolor=\"#eadcf2\">{}{}{}</table>>",
      fmt::format(fmt::runtime(row), one_above ? "1" : "0", label),
      fmt::format(fmt::runtime(row), one_above ? "0" : "1", ""), fmt::format(fmt::runtime(row), "s", ""));
}

/// What a comparator of units tells by each bit of its result.
constexpr std::array<std::string_view, 2> order_signs{"<", ">"};

std::string_view turned(std::string_view sign) {
  return sign == "<" ? ">" : "<";
}

std::string number_text(const Node& constant, const Node& reader) {
  if (reader.op == Op::call && constant.value != 0) return fmt::format("{:#x}", constant.value);
  return reader.is_signed ? fmt::format("{}", number_of(constant.value, constant.width))
                          : fmt::format("{}", constant.value);
}

class Drawing {
 public:
  Drawing(const Pipeline& pipeline, const std::vector<Port>& ports, const std::string& title,
          StageRange range)
      : graph_(pipeline.graph),
        schedule_(pipeline.schedule),
        placement_(pipeline.placement),
        interval_(pipeline.interval()),
        names_(value_names(graph_, placement_, {})),
        places_(axis_order(graph_, ports)),
        entry_(range.first - 1) {
    // Operations that share a component are drawn apart, and so are their registers.
    for (const Register& r : placement_.registers)
      for (const Passing& p : r.values())
        registers_.push_back({.value = p.value, .boundary = p.boundary, .high = r.high, .low = r.low});
    text_ = fmt::format(
        "digraph schematic {{\n"
        "  graph [rankdir=LR label=\"{}\" labelloc=t fontname=\"Helvetica\" fontsize=20 nodesep=0.12 "
        "ranksep=0.5 newrank=true]\n"
        "  node [fontname=\"Helvetica\" fontsize=11 style=filled fillcolor=white height=0.3 width=0.3"
        " margin=\"0.06,0.03\"]\n"
        "  edge [fontname=\"Helvetica\" fontsize=9 arrowsize=0.5 color=\"#555555\"]\n",
        title);
    for (int stage = range.first; stage <= range.last; ++stage) {
      write_stage(stage);
      write_latches(stage);
      if (stage > range.first)
        edges_ += fmt::format("  after_{} -> after_{} [style=invis]\n", stage - 1, stage);
    }
    if (range.last == schedule_.stages) write_outputs();
    text_ += edges_;
  }

  [[nodiscard]] std::string take() { return std::move(text_) + "}\n"; }

 private:
  [[nodiscard]] bool is_above(NodeId a, NodeId b) const {
    return places_[a] < places_[b] || (places_[a] == places_[b] && a < b);
  }

  /// Components and gates that start in a stage, one column for each of their depths.
  void write_stage(int stage) {
    std::map<int, std::vector<NodeId>> columns;
    std::vector<int> depth(graph_.size(), 0);
    for (NodeId id = 0; id < graph_.size(); ++id) {
      if (graph_[id].op == Op::input || !is_root(graph_[id].op) || schedule_.slots[id].stage != stage)
        continue;
      for_each_source(graph_, id,
                      [&](NodeId source, Word) { depth[id] = std::max(depth[id], depth[source] + 1); });
      columns[depth[id]].push_back(id);
    }
    for (auto& [unused, column] : columns) {
      std::sort(column.begin(), column.end(), [&](NodeId a, NodeId b) { return is_above(a, b); });
      std::vector<std::string> nodes;
      for (const NodeId id : column) {
        nodes.push_back(fmt::format("v{}", id));
        text_ += fmt::format("  v{} [{} tooltip=\"{}\"]\n", id, symbol(id), names_[id].name);
        connect_operands(id, stage);
      }
      write_order(nodes);
    }
  }

  void write_latches(int boundary) {
    std::vector<const Register*> column;
    for (const Register& r : registers_)
      if (r.boundary == boundary) column.push_back(&r);
    std::stable_sort(column.begin(), column.end(), [&](const Register* a, const Register* b) {
      return a->value != b->value && is_above(a->value, b->value);
    });
    std::vector<std::string> nodes{fmt::format("after_{}", boundary)};
    text_ += fmt::format("  after_{0} [label=\"stage {0}\" shape=plaintext fontsize=14]\n", boundary);
    for (const Register* const r : column) {
      nodes.push_back(node_of(*r));
      text_ += fmt::format("  {} [label=\"L:{}\" shape=box fillcolor=\"#ffffff\" tooltip=\"{}\"]\n",
                           nodes.back(), r->width(), names_[r->value].name);
      const Slot& slot = schedule_.slots[r->value];
      const bool first = graph_[r->value].op != Op::input && boundary == slot.finish;
      // A component of several stages takes as many columns.
      const std::string wire = first ? fmt::format(" [label=\"{}\" minlen={}]", names_[r->value].name,
                                                   std::max(1, slot.finish - slot.stage))
                                     : "";
      const std::string from = first && schedule_.slots[r->value].stage > entry_
                                   ? fmt::format("v{}", r->value)
                                   : source_of(r->value, r->high, r->low, boundary - 1);
      edges_ += fmt::format("  {} -> {}{}\n", from, nodes.back(), wire);
    }
    write_order(nodes);
  }

  void write_outputs() {
    for (const Output& out : graph_.outputs()) {
      text_ += fmt::format("  out_{0} [label=\"{0}\" shape=plaintext fontsize=14]\n", out.name);
      connect(out.node, schedule_.stages + 1, fmt::format("out_{}", out.name), graph_[out.node]);
    }
  }

  /// Puts nodes into one column, the first on top.
  void write_order(const std::vector<std::string>& nodes) {
    text_ += fmt::format("  {{ rank=same {} }}\n", fmt::join(nodes, " "));
    for (std::size_t i = 1; i < nodes.size(); ++i)
      edges_ += fmt::format("  {} -> {} [style=invis]\n", nodes[i - 1], nodes[i]);
  }

  [[nodiscard]] bool is_order(NodeId id) const {
    return graph_[id].op == Op::call && graph_.submodule_of(id)->component == "fp_compare";
  }
  /// The second of two operands is drawn above the first. A difference keeps the order of its operands.
  [[nodiscard]] bool is_turned(NodeId id) const {
    const Node& n = graph_[id];
    if (n.op != Op::less && !is_order(id)) return false;
    return graph_[n.args[0]].op == Op::constant || places_[n.args[1]] < places_[n.args[0]];
  }

  /// What the result, or a bit of it, says of the upper operand and the lower one.
  [[nodiscard]] std::string_view sign_of(NodeId id, int bit) const {
    const std::string_view sign = order_signs.at(static_cast<std::size_t>(bit));
    return is_turned(id) ? turned(sign) : sign;
  }

  [[nodiscard]] std::string symbol(NodeId id) const {
    const Node& n = graph_[id];
    switch (n.op) {
      case Op::sub:
        return difference_style;
      case Op::add:
        return "label=\"+\" shape=circle fillcolor=\"#cfe3f5\"";
      case Op::mul:
        return product_style;
      case Op::less:
        return comparator(sign_of(id, 0));
      case Op::equal:
        return comparator("=");
      case Op::mux:
        return multiplexer(n.width, one_is_above(id));
      case Op::bit_and:
        return "label=\"AND\" shape=box style=\"filled,rounded\"";
      case Op::bit_or:
        return "label=\"OR\" shape=box style=\"filled,rounded\"";
      case Op::bit_xor:
        return "label=\"XOR\" shape=box style=\"filled,rounded\"";
      default:
        return unit_symbol(id);
    }
  }

  [[nodiscard]] std::string unit_symbol(NodeId id) const {
    const std::string& component = graph_.submodule_of(id)->component;
    if (component == "fp_subtract") return difference_style;
    if (component == "fp_multiply") return product_style;
    if (!is_order(id)) return fmt::format("label=\"{}\" shape=box", component);
    std::string signs;
    for (const int bit : {0, 1})
      if ((placement_.used_bits[id] >> bit & 1) != 0) signs += sign_of(id, bit);
    return comparator(signs);
  }

  [[nodiscard]] bool one_is_above(NodeId mux) const {
    const Node& n = graph_[mux];
    return places_[n.args[1]] <= places_[n.args[2]];
  }

  /// The point of a node where an operand enters. Where the order of operands matters it is drawn.
  [[nodiscard]] std::string point_of(NodeId id, std::size_t operand) const {
    const Node& n = graph_[id];
    if (n.op == Op::mux) return fmt::format("v{}:{}:w", id, operand == 0 ? "s" : operand == 1 ? "1" : "0");
    if (n.arity() != 2 || n.op == Op::bit_and || n.op == Op::bit_or || n.op == Op::bit_xor)
      return fmt::format("v{}", id);
    return fmt::format("v{}:{}", id, (operand == 0) != is_turned(id) ? "nw" : "sw");
  }

  void connect_operands(NodeId id, int stage) {
    const Node& n = graph_[id];
    for (std::size_t i = 0; i < n.operands().size(); ++i) connect(n.operands()[i], stage, point_of(id, i), n);
  }

  void connect(NodeId value, int stage, const std::string& to, const Node& reader) {
    const bool inverted = graph_[value].op == Op::invert;
    connect_constants(value, to, reader);
    for_each_source_of(graph_, value, [&](NodeId source, Word bits) {
      const int high = width_of_bits(bits) - 1;
      const int low = low_zeros(bits);
      const BitSpan used = used_span(graph_, placement_, source);
      std::string attributes = inverted ? " arrowhead=odot" : "";
      if (high == low && used.width() > 1) {
        attributes += fmt::format(" label=\"{}\" style=dashed", bit_label(source, high));
      }
      edges_ += fmt::format("  {} -> {} [{}]\n", source_of(source, high, low, stage - 1), to, attributes);
    });
  }

  /// A constant stands at its reader, with its name if the C++ gives one.
  void connect_constants(NodeId value, const std::string& to, const Node& reader) {
    const Node& n = graph_[value];
    if (is_wire(n.op))
      for (const NodeId arg : n.operands()) connect_constants(arg, to, reader);
    if (n.op != Op::constant) return;
    const std::string number = number_text(n, reader);
    write_entry(n.name.empty() ? number : fmt::format("{} = {}", n.name, number), to);
  }

  /// The drawn node that holds these bits of a value: a latch at the boundary, the node that makes the value,
  /// or its name.
  std::string source_of(NodeId value, int high, int low, int boundary) {
    // A register holds its value for as many stages as the interval has cycles.
    for (int b = boundary; b > std::max(entry_, boundary - interval_); --b)
      for (const Register& r : registers_)
        if (r.value == value && r.boundary == b && r.low <= low && r.high >= high) return node_of(r);
    if (schedule_.slots[value].stage <= entry_) return entry(names_[value].name);
    return fmt::format("v{}", value);
  }

  static std::string node_of(const Register& r) {
    return fmt::format("r{}_{}_{}_{}", r.value, r.boundary, r.high, r.low);
  }

  std::string entry(const std::string& label) {
    const std::string id = fmt::format("in{}", entries_++);
    edges_ += fmt::format("  {} [label=\"{}\" shape=plaintext fillcolor=none]\n", id, label);
    return id;
  }
  void write_entry(const std::string& label, const std::string& to) {
    const std::string id = entry(label);
    edges_ += fmt::format("  {} -> {} []\n", id, to);
  }

  [[nodiscard]] std::string bit_label(NodeId value, int bit) const {
    if (is_order(value)) return std::string(sign_of(value, bit));
    return bit == graph_[value].width - 1 ? "sign" : fmt::format("[{}]", bit);
  }

  const Graph& graph_;
  const Schedule& schedule_;
  const Placement& placement_;
  std::vector<Register> registers_;
  int interval_;
  std::vector<ValueName> names_;
  std::vector<double> places_;  ///< by node, from the top
  int entry_;                   ///< the boundary before the first stage
  int entries_ = 0;
  std::string edges_;  // also nodes that stand at one reader
  std::string text_;
};

}  // namespace

std::vector<StageRange> stage_groups(const Pipeline& pipeline) {
  std::set<int> starts{1};
  for (NodeId id = 0; id < pipeline.graph.size(); ++id)
    if (is_component(pipeline.graph[id].op)) starts.insert(pipeline.schedule.slots[id].stage);
  std::vector<StageRange> groups;
  for (const int first : starts) {
    if (!groups.empty()) groups.back().last = first - 1;
    groups.push_back({first, pipeline.schedule.stages});
  }
  return groups;
}

std::string to_dot(const Pipeline& pipeline, const std::vector<Port>& ports, const std::string& title,
                   StageRange range) {
  return Drawing(pipeline, ports, title, range).take();
}

}  // namespace hitpipe::rtl
