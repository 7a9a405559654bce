#include "tests/formal/combinational.hpp"

#include <vector>

#include <fmt/format.h>

#include "rtl_gen/graph/canonical.hpp"
#include "rtl_gen/verilog/body.hpp"

namespace hitpipe::rtl {

std::string to_combinational_verilog(const Graph& traced, const std::string& name) {
  const Graph graph = canonical(traced);
  const Schedule schedule = schedule_as_stated(graph, 1);
  const Placement placement = place_registers(graph, schedule, Ports::direct);
  const Body body(graph, schedule, placement, {.prefix = name, .enable = ""});

  ModuleInterface module{name, {}};
  add_data(module.pins, tests_channel, true, input_ports(graph));
  for (const Output& out : graph.outputs())
    add_data(module.pins, results_channel, false, {{out.name, graph[out.node].width, false}});
  std::string text = module.head() + body.text();
  for (const Output& out : graph.outputs())
    text += fmt::format("  assign {} = {};\n", out.name, body.expression(out.node, 1));
  text += "endmodule\n";
  for (const auto& [unit, use] : body.units())
    text += fmt::format("\n{}", to_combinational_verilog(use.unit->body, unit));
  return text;
}

}  // namespace hitpipe::rtl
