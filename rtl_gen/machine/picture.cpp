#include "rtl_gen/machine/picture.hpp"

#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

namespace hitpipe::rtl {

namespace {

/// "cycle 2" of ray_2; "kept" of a register without such an end.
std::string group_of(const std::string& name) {
  const std::size_t end = name.find_last_not_of("0123456789");
  if (end == std::string::npos || end + 1 == name.size() || name[end] != '_') return "kept";
  return fmt::format("cycle {}", name.substr(end + 1));
}

/// A box of the picture, with a line for each of its fields.
std::string table(const std::string& title, const std::vector<const hls::Field*>& fields,
                  const char* colour) {
  std::string rows = fmt::format("<tr><td colspan=\"2\"><b>{}</b></td></tr>", title);
  for (const hls::Field* const field : fields)
    rows += fmt::format("<tr><td align=\"left\">{}</td><td align=\"right\">{}</td></tr>", field->name,
                        field->width);
  return fmt::format(
      "  \"{}\" [shape=plain label=<<table border=\"1\" cellborder=\"0\" cellspacing=\"0\" "
      "cellpadding=\"2\" bgcolor=\"{}\">{}</table>>]\n",
      title, colour, rows);
}

/// The box in which each name of the graph stands.
class Places {
 public:
  explicit Places(const MachineGraph& machine) {
    for (const hls::Field& field : machine.inputs) inputs_[field.name] = "inputs";
    for (const hls::Field& field : machine.outputs) outputs_[field.name] = "outputs";
    for (const hls::Field& field : machine.state) {
      inputs_[field.name] = group_of(field.name);
      outputs_[fmt::format("next_{}", field.name)] = group_of(field.name);
    }
    for (const hls::MemoryShape& memory : machine.memories) {
      inputs_[memory_port(memory, "word")] = memory.name;
      for (const char* const what : {"asked", "read", "writes", "place", "written"})
        outputs_[memory_port(memory, what)] = memory.name;
    }
  }
  [[nodiscard]] const std::string& of_input(const std::string& name) const { return inputs_.at(name); }
  [[nodiscard]] const std::string& of_output(const std::string& name) const { return outputs_.at(name); }

 private:
  std::map<std::string, std::string> inputs_, outputs_;
};

}  // namespace

std::string to_dot(const MachineGraph& machine, const std::string& title) {
  std::string text = fmt::format(
      "digraph machine {{\n"
      "  graph [rankdir=LR label=\"{}: bits of its ports, registers and memories\" labelloc=t "
      "fontname=\"Helvetica\" fontsize=20 nodesep=0.3 ranksep=0.8]\n"
      "  node [fontname=\"Helvetica\" fontsize=12]\n"
      "  edge [arrowsize=0.6 color=\"#555555\"]\n",
      title);
  const auto all = [](const std::vector<hls::Field>& fields) {
    std::vector<const hls::Field*> pointers;
    for (const hls::Field& field : fields) pointers.push_back(&field);
    return pointers;
  };
  text += table("inputs", all(machine.inputs), "#ffffff");
  std::map<std::string, std::vector<const hls::Field*>> registers;
  for (const hls::Field& field : machine.state) registers[group_of(field.name)].push_back(&field);
  for (const auto& [group, fields] : registers) text += table(group, fields, "#cfe3f5");
  for (const hls::MemoryShape& memory : machine.memories)
    text += fmt::format(
        "  \"{0}\" [shape=box style=filled fillcolor=\"#f6d5a8\" label=\"{0}\\n{1} words of {2}, {3}\"]\n",
        memory.name, memory.words, memory.width, memory.kind_name());
  text += table("outputs", all(machine.outputs), "#ffffff");

  const Places places(machine);
  const std::vector<std::set<std::string>> sources = dependences(machine.graph);
  std::set<std::pair<std::string, std::string>> edges;
  for (const Output& out : machine.graph.outputs())
    for (const std::string& source : sources[out.node]) {
      const std::string &from = places.of_input(source), &to = places.of_output(out.name);
      if (from != to) edges.insert({from, to});
    }
  for (const auto& [from, to] : edges) text += fmt::format("  \"{}\" -> \"{}\"\n", from, to);
  return text + "}\n";
}

}  // namespace hitpipe::rtl
