#include "tests/formal/combinational.hpp"

#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rtl_gen/graph/canonical.hpp"
#include "rtl_gen/verilog/body.hpp"

namespace hitpipe::rtl {

std::string to_combinational_verilog(const Graph& traced, const std::string& name) {
  const Graph graph = canonical(traced);
  const Schedule schedule = schedule_as_stated(graph, 1);
  const Placement placement = place_registers(graph, schedule, Ports::direct);
  const Body body(graph, schedule, placement, {.prefix = name, .enable = ""});

  std::vector<std::string> ports;
  for (const NodeId id : graph.inputs())
    ports.push_back(fmt::format("input  wire {}{}", vector_range(graph[id].width), graph[id].name));
  for (const Output& out : graph.outputs())
    ports.push_back(fmt::format("output wire {}{}", vector_range(graph[out.node].width), out.name));
  std::string text = fmt::format("module {} (\n  {}\n);\n{}", name, fmt::join(ports, ",\n  "), body.text());
  for (const Output& out : graph.outputs())
    text += fmt::format("  assign {} = {};\n", out.name, body.expression(out.node, 1));
  text += "endmodule\n";
  for (const auto& [module, use] : body.units())
    text += fmt::format("\n{}", to_combinational_verilog(use.unit->body, module));
  return text;
}

}  // namespace hitpipe::rtl
