#include "rtl_gen/machine/machine.hpp"

#include <algorithm>
#include <bit>
#include <map>
#include <set>
#include <stdexcept>

#include <fmt/format.h>

#include "rtl_gen/graph/sources.hpp"
#include "rtl_gen/verilog/names.hpp"

namespace hitpipe::rtl {

namespace {

/// Collects the broken rules of one machine.
class Rules {
 public:
  explicit Rules(const MachineGraph& machine) : machine_(machine), graph_(machine.graph) {}

  std::vector<std::string> broken() {
    for (const hls::Field& field : machine_.state) {
      check_name(field.name);
      check_width(field.name, field.width, most_value_bits);
      expect_input(field.name, field.width);
      expect_output(fmt::format("next_{}", field.name), field.width);
    }
    for (const hls::Field& field : machine_.inputs) {
      check_name(field.name);
      check_width(field.name, field.width, most_port_bits);
      expect_input(field.name, field.width);
    }
    for (const hls::Field& field : machine_.outputs) {
      check_name(field.name);
      check_width(field.name, field.width, most_port_bits);
      expect_output(field.name, field.width);
    }
    for (const hls::MemoryShape& memory : machine_.memories) check_memory(memory);
    for (const NodeId id : graph_.inputs())
      if (!inputs_.contains(graph_[id].name)) add("input {} of the graph: nothing gives it", graph_[id].name);
    for (const Output& out : graph_.outputs())
      if (!outputs_.contains(out.name)) add("output {} of the graph: nothing takes it", out.name);
    check_paths();
    return std::move(broken_);
  }

 private:
  template <class... Args>
  void add(fmt::format_string<Args...> format, Args&&... args) {
    broken_.push_back(machine_.name + ": " + fmt::format(format, std::forward<Args>(args)...));
  }

  void check_name(const std::string& name) {
    try {
      check_module_name(name);
    } catch (const std::runtime_error& error) {
      broken_.push_back(machine_.name + ": " + error.what());
    }
    if (name == "clk" || name == "rst" || !names_.insert(name).second) add("{}: the name is taken", name);
    if (name == "near" || name == "far") add("{}: Verilator calls it otherwise", name);
  }
  void check_width(const std::string& name, int width, int most) {
    if (width < 1 || width > most) add("{} has {} bits; allowed are 1 to {}", name, width, most);
  }
  void expect_input(const std::string& name, int width) {
    inputs_.insert(name);
    for (const NodeId id : graph_.inputs())
      if (graph_[id].name == name && graph_[id].width == width) return;
    add("{}: the graph has no input of {} bits for it", name, width);
  }
  void expect_output(const std::string& name, int width) {
    outputs_.insert(name);
    const auto same_name = [&](const Output& out) { return out.name == name; };
    const auto found = std::count_if(graph_.outputs().begin(), graph_.outputs().end(), same_name);
    if (found != 1) {
      add("the step gives {} {} times", name, found);
      return;
    }
    const Output& out = *std::find_if(graph_.outputs().begin(), graph_.outputs().end(), same_name);
    if (graph_[out.node].width != width)
      add("{} has {} bits; allowed are {}", name, graph_[out.node].width, width);
  }
  void check_memory(const hls::MemoryShape& memory) {
    check_name(memory.name);
    check_width(memory.name, memory.width, most_value_bits);
    const auto words = static_cast<unsigned>(std::max(memory.words, 0));
    if (words < 2 || !std::has_single_bit(words)) {
      add("{} has {} words; allowed are powers of two from 2 on", memory.name, memory.words);
      return;
    }
    const int place_bits = std::countr_zero(words);
    expect_input(memory_port(memory, "word"), memory.width);
    if (memory.kind != hls::MemoryKind::single)
      expect_output(memory_port(memory, memory.is_late() ? "asked" : "read"), place_bits);
    if (!memory.is_written()) {
      if (memory.contents == nullptr) add("{} is never written, and has no contents", memory.name);
      return;
    }
    expect_output(memory_port(memory, "writes"), 1);
    expect_output(memory_port(memory, "place"), place_bits);
    expect_output(memory_port(memory, "written"), memory.width);
  }

  void check_paths() {
    const auto known = dependences(graph_);
    std::set<std::string> outputs, inputs, places, words;
    for (const hls::Field& field : machine_.outputs) outputs.insert(field.name);
    for (const hls::Field& field : machine_.inputs) inputs.insert(field.name);
    for (const hls::MemoryShape& memory : machine_.memories)
      if (memory.kind == hls::MemoryKind::lookup) {
        places.insert(memory_port(memory, "read"));
        words.insert(memory_port(memory, "word"));
      }
    for (const Output& out : graph_.outputs())
      for (const std::string& source : known[out.node]) {
        if (outputs.contains(out.name) && inputs.contains(source))
          add("output {} depends on input {}, so a path leads through the machine", out.name, source);
        if (places.contains(out.name) && words.contains(source))
          add("{} depends on {}: a word that is read says which word is read", out.name, source);
      }
  }

  const MachineGraph& machine_;
  const Graph& graph_;
  std::set<std::string> names_, inputs_, outputs_;
  std::vector<std::string> broken_;
};

void check_format(const Machine& machine, const Format& format) {
  const FormatFamily& own = machine.default_format.family();
  if (&format.family() != &own || !format.valid())
    throw std::runtime_error(
        fmt::format("machine {}: bits {}: allowed is {}", machine.name, to_string(format), own.allowed()));
}

}  // namespace

std::vector<std::set<std::string>> dependences(const Graph& graph) {
  std::vector<std::set<std::string>> known(graph.size());
  for (NodeId id = 0; id < graph.size(); ++id) {
    if (graph[id].op == Op::input) known[id].insert(graph[id].name);
    for (const NodeId arg : graph[id].operands()) known[id].insert(known[arg].begin(), known[arg].end());
  }
  return known;
}

std::string memory_port(const hls::MemoryShape& memory, std::string_view what) {
  return fmt::format("{}_{}", memory.name, what);
}

std::vector<std::string> verify(const MachineGraph& machine) {
  return Rules(machine).broken();
}

Format Machine::parse_format(std::string_view text) const {
  return hitpipe::parse_format(default_format.family(), text);
}

MachineGraph Machine::graph(const Format& format) const {
  check_format(*this, format);
  MachineGraph made = graph_at(format);
  const std::vector<std::string> broken = verify(made);
  if (!broken.empty()) throw std::logic_error(broken.front());
  return made;
}

std::unique_ptr<JoinedMachine> Machine::native(const Format& format, Collision collision) const {
  check_format(*this, format);
  return native_at(format, collision);
}

std::string Machine::module_at(const Format& format) const {
  return format == default_format ? std::string(name) : fmt::format("{}_{}", name, format.identifier());
}

const Machine* machine_called(std::string_view name) {
  const auto found = std::find_if(machines().begin(), machines().end(),
                                  [&](const Machine& machine) { return machine.name == name; });
  return found == machines().end() ? nullptr : &*found;
}

}  // namespace hitpipe::rtl
