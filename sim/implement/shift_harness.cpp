#include "sim/implement/shift_harness.hpp"

#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace hitpipe::sim {

std::vector<ChipPort> ports_of_netlist(const std::string& json, const std::string& module) {
  const auto netlist = nlohmann::ordered_json::parse(json, nullptr, false);
  const auto place = nlohmann::ordered_json::json_pointer("/modules/" + module + "/ports");
  if (netlist.is_discarded() || !netlist.contains(place))
    throw std::runtime_error(fmt::format("Yosys's netlist has no module {}", module));
  std::vector<ChipPort> ports;
  for (const auto& [name, port] : netlist[place].items())
    ports.push_back({name, static_cast<int>(port["bits"].size()), port["direction"] == "input"});
  return ports;
}

std::string harness_module(const std::string& unit) {
  return unit + "_harness";
}

std::string shift_harness(const std::string& unit, const std::string& clock,
                          const std::vector<ChipPort>& ports) {
  int in = 0;
  int out = 0;
  std::string connections = fmt::format(".{0}({0})", clock);
  for (const ChipPort& port : ports) {
    if (port.name == clock) continue;
    int& used = port.is_input ? in : out;
    connections += fmt::format(",\n    .{}({}[{}:{}])", port.name, port.is_input ? "operands" : "results",
                               used + port.width - 1, used);
    used += port.width;
  }
  return fmt::format(R"(// Shift registers around {unit}, for placement only.
module {module} (
  input  wire {clock},
  input  wire shift_clk,
  input  wire shift_in,
  input  wire shift_load,
  output wire shift_out
);
  reg [{in}:0] operands;
  wire [{out}:0] results;
  reg [{out}:0] shifted;
  {unit} unit (
    {connections}
  );
  always @(posedge shift_clk) begin
    operands <= (operands << 1) | shift_in;
    shifted <= shift_load ? results : shifted << 1;
  end
  assign shift_out = shifted[{out}];
endmodule
)",
                     fmt::arg("unit", unit), fmt::arg("module", harness_module(unit)),
                     fmt::arg("clock", clock), fmt::arg("in", in - 1), fmt::arg("out", out - 1),
                     fmt::arg("connections", connections));
}

}  // namespace hitpipe::sim
