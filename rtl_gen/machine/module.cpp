#include "rtl_gen/machine/module.hpp"

#include <algorithm>
#include <bit>
#include <stdexcept>

#include <fmt/format.h>

#include "rtl_gen/graph/canonical.hpp"
#include "rtl_gen/graph/sources.hpp"
#include "rtl_gen/schedule/chaining.hpp"
#include "rtl_gen/schedule/divided_unit.hpp"
#include "rtl_gen/verilog/body.hpp"

namespace hitpipe::rtl {

namespace {

NodeId output_of(const Graph& graph, const std::string& name) {
  const auto found = std::find_if(graph.outputs().begin(), graph.outputs().end(),
                                  [&](const Output& out) { return out.name == name; });
  if (found == graph.outputs().end()) throw std::logic_error(graph.name() + ": no output " + name);
  return found->node;
}

Port port_of_field(const std::string& name, const hls::Field& field) {
  return {name, field.width, field.is_signed};
}

std::string shown_name(const hls::Field& field) {
  return fmt::format("state_{}", field.name);
}

/// When the values of a step are there, and the value that each waits for.
class Times {
 public:
  Times(const Graph& graph, const std::vector<hls::MemoryShape>& memories, const Library& library)
      : graph_(graph),
        timing_(graph_, library),
        ps_per_bit_(library.carry_delay_ps_per_bit()),
        ready_(graph_.size()),
        after_(graph_.size(), no_node) {
    run();
    for (const hls::MemoryShape& memory : memories)
      if (memory.kind == hls::MemoryKind::lookup) read(memory, library);
    run();
  }

  /// Of the bits that wires bring to a value.
  [[nodiscard]] NodeId last_source(NodeId value) const {
    NodeId last = no_node;
    for_each_source_of(graph_, value, [&](NodeId source, Word) {
      if (last == no_node || ready_ps(source) > ready_ps(last)) last = source;
    });
    return last;
  }
  [[nodiscard]] int ready_ps(NodeId root) const { return root == no_node ? 0 : ready_[root].all_ps; }
  [[nodiscard]] NodeId after(NodeId root) const { return after_[root]; }

 private:
  void run() {
    for (NodeId id = 0; id < graph_.size(); ++id) {
      if (!is_root(graph_[id].op) || graph_[id].op == Op::input) continue;
      for_each_source(graph_, id, [&](NodeId source, Word) {
        if (after_[id] == no_node || ready_ps(source) > ready_ps(after_[id])) after_[id] = source;
      });
      // A component with stages has no latches here: its stages follow each other in one cycle.
      Cell cell = timing_(id);
      cell.delay_ps *= std::max(1, cell.stages);
      const Arrival operands =
          operands_of(graph_, id, cell, ps_per_bit_, [&](NodeId source) { return ready_[source]; });
      ready_[id] = result_of(graph_[id].op, cell, operands);
    }
  }
  /// A multiplexer of all words.
  void read(const hls::MemoryShape& memory, const Library& library) {
    const std::string word = memory_port(memory, "word");
    const NodeId place = last_source(output_of(graph_, memory_port(memory, "read")));
    const int levels = std::countr_zero(static_cast<unsigned>(memory.words));
    for (const NodeId id : graph_.inputs())
      if (graph_[id].name == word) {
        const int ps = ready_ps(place) + levels * library.timing(Component::mux2, memory.width).delay_ps;
        ready_[id] = {ps, ps};
        after_[id] = place;
      }
  }

  const Graph& graph_;
  NodeTiming timing_;
  int ps_per_bit_;
  std::vector<Arrival> ready_;
  std::vector<NodeId> after_;
};

/// Assignments under one edge; empty without any.
std::string at_edge(const std::string& assignments) {
  if (assignments.empty()) return "";
  return fmt::format("  always @(posedge clk) begin\n{}  end\n", assignments);
}

std::string contents_of(const hls::MemoryShape& memory) {
  std::string text = "  initial begin\n";
  for (int i = 0; i < memory.words; ++i)
    text += fmt::format("    {}[{}] = {}'h{:x};\n", memory.name, i, memory.width, memory.contents[i]);
  return text + "  end\n";
}

}  // namespace

ModuleInterface machine_interface(const std::string& module, const MachineGraph& machine) {
  ModuleInterface made{module, {{"clk", Pin::Role::clock, "", true}, {"rst", Pin::Role::reset, "", true}}};
  std::vector<Port> inputs, outputs;
  for (const hls::Field& field : machine.inputs) inputs.push_back(port_of_field(field.name, field));
  for (const hls::Field& field : machine.outputs) outputs.push_back(port_of_field(field.name, field));
  add_data(made.pins, tests_channel, true, inputs);
  add_data(made.pins, results_channel, false, outputs);
  return made;
}

MachinePath longest_path(const MachineGraph& machine, const Library& library) {
  const Graph graph = canonical(machine.graph);
  const Times times(graph, machine.memories, library);
  const Output* longest = nullptr;
  NodeId last = no_node;
  for (const Output& out : graph.outputs()) {
    const NodeId source = times.last_source(out.node);
    if (longest != nullptr && times.ready_ps(source) <= times.ready_ps(last)) continue;
    longest = &out;
    last = source;
  }
  if (longest == nullptr) throw std::logic_error(graph.name() + ": a step without outputs");
  MachinePath path{.clock_ps = times.ready_ps(last) + library.latch_delay_ps(), .names = {longest->name}};
  for (NodeId id = last; id != no_node; id = times.after(id))
    if (!graph[id].name.empty()) path.names.push_back(graph[id].name);
  std::reverse(path.names.begin(), path.names.end());
  return path;
}

std::string to_verilog(const MachineGraph& machine, const MachineModule& options) {
  const Graph graph = canonical(machine.graph);
  const Schedule schedule = schedule_as_stated(graph, 1);
  const Placement placement = place_registers(graph, schedule, Ports::direct);
  std::set<std::string> taken{"clk", "rst"};
  for (const hls::MemoryShape& memory : machine.memories) taken.insert(memory.name);
  for (const hls::Field& field : machine.state) taken.insert(shown_name(field));
  const Body body(graph, schedule, placement,
                  {.prefix = options.module, .enable = "", .taken = taken, .is_step = true});
  const auto value = [&](const std::string& name) { return body.expression(output_of(graph, name), 1); };

  ModuleInterface interface = machine_interface(options.module, machine);
  if (options.shows_state) {
    std::vector<Port> shown;
    for (const hls::Field& field : machine.state) shown.push_back(port_of_field(shown_name(field), field));
    add_data(interface.pins, results_channel, false, shown);
  }
  std::string text = fmt::format(
      "// {}{}{}: a machine. A reset sets the registers that say a value; the others hold what they have.\n"
      "// Generated by hitpipe; do not edit. A comment names the C++ line of a value; \"for\": the value has "
      "no\n"
      "// name in the C++ and is computed for the value of that line.\n{}",
      options.module, options.bits.empty() ? "" : " ", options.bits, interface.head());

  text += "\n  // State.\n";
  for (const hls::Field& field : machine.state)
    text += fmt::format("  reg {}{};{}\n", vector_range(field.width), field.name,
                        field.has_reset ? fmt::format("  // {} after a reset", field.reset) : "");
  for (const hls::Field& field : machine.state)
    if (field.has_start)
      text += fmt::format("  initial {} = {}'d0;  // for simulators\n", field.name, field.width);
  if (!machine.memories.empty()) text += "\n  // Memories.\n";
  for (const hls::MemoryShape& memory : machine.memories) {
    const bool late = memory.is_late();
    if (options.in_block_rams.contains(memory.name))
      text += "  (* no_rw_check, ram_style = \"block\" *)\n";
    else if (memory.is_apart)
      text += "  (* no_rw_check *)\n";
    // Without this mark Yosys takes many block RAMs, or has too few.
    if (memory.kind == hls::MemoryKind::single) text += "  (* ram_style = \"huge\" *)\n";
    text += fmt::format("  reg {0}{1} [0:{2}];\n  {3} {0}{4};{5}\n", vector_range(memory.width), memory.name,
                        memory.words - 1, late ? "reg" : "wire", memory_port(memory, "word"),
                        late ? "  // the word that the last cycle asked for" : "");
  }
  text += body.text();

  text += "\n  // Outputs.\n";
  for (const hls::Field& field : machine.outputs)
    text += fmt::format("  assign {} = {};\n", field.name, value(field.name));
  if (options.shows_state)
    for (const hls::Field& field : machine.state)
      text += fmt::format("  assign {} = {};\n", shown_name(field), field.name);

  text += "\n  // The next state.\n";
  std::string resets, next, data;
  for (const hls::Field& field : machine.state) {
    const std::string line =
        fmt::format("{} <= {};\n", field.name, value(fmt::format("next_{}", field.name)));
    if (!field.has_reset) {
      data += "    " + line;
      continue;
    }
    const Word reset = static_cast<Word>(field.reset) & ones_below(field.width);
    resets += fmt::format("      {} <= {}'h{:x};\n", field.name, field.width, reset);
    next += "      " + line;
  }
  if (!resets.empty())
    text += at_edge(fmt::format("    if (rst) begin\n{}    end else begin\n{}    end\n", resets, next));
  text += at_edge(data);
  for (const hls::MemoryShape& memory : machine.memories) {
    const auto of = [&](const char* what) { return value(memory_port(memory, what)); };
    std::string edge;
    if (memory.is_written())
      edge =
          fmt::format("    if ({}) {}[{}] <= {};\n", of("writes"), memory.name, of("place"), of("written"));
    else
      text += "\n" + contents_of(memory);
    if (memory.kind == hls::MemoryKind::single)
      edge += fmt::format("    else {} <= {}[{}];\n", memory_port(memory, "word"), memory.name, of("place"));
    else if (memory.is_late())
      edge += fmt::format("    {} <= {}[{}];\n", memory_port(memory, "word"), memory.name, of("asked"));
    text += "\n" + at_edge(edge);
    if (memory.kind == hls::MemoryKind::lookup)
      text += fmt::format("  assign {} = {}[{}];\n", memory_port(memory, "word"), memory.name, of("read"));
  }
  return text + "endmodule\n";
}

}  // namespace hitpipe::rtl
