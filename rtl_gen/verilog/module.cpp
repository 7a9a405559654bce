#include "rtl_gen/verilog/module.hpp"

#include <map>
#include <set>

#include <fmt/format.h>

#include "rtl_gen/component/product.hpp"
#include "rtl_gen/schedule/divided_unit.hpp"
#include "rtl_gen/verilog/body.hpp"

namespace hitpipe::rtl {

namespace {

std::vector<Port> output_ports(const Graph& graph) {
  std::vector<Port> ports;
  for (const Output& out : graph.outputs()) ports.push_back({out.name, graph[out.node].width, false});
  return ports;
}

std::string multiplier_module(const MultiplierShape& shape, const std::string& name, FlowControl flow);

/// The graph's operands with what the design says of them.
std::vector<Port> described_operands(const Graph& graph, const std::vector<Port>& said) {
  std::vector<Port> ports = input_ports(graph);
  for (Port& port : ports) {
    const auto place = index_of(said, port.name);
    if (!place) continue;
    Port whole = said[*place];
    // Fewer bits have other numbers.
    if (whole.width != port.width) whole.range.reset();
    port.comment = description(whole);
  }
  return ports;
}

std::vector<Port> described_results(const Graph& graph, const std::vector<hls::Result>& said) {
  std::vector<Port> ports = output_ports(graph);
  for (Port& port : ports)
    for (const Port& result : result_ports(said))
      if (result.name == port.name && result.width == port.width) port = result;
  return ports;
}

/// Inside a component every operand is a pattern, and an operation says how it reads it.
std::vector<Port> as_patterns(std::vector<Port> ports) {
  for (Port& port : ports) port.is_signed = false;
  return ports;
}

/// A component inside a pipeline. Its operands come out of latches; the pipeline latches its result.
std::string component_module(const DividedUnit& unit, const std::string& name, FlowControl flow,
                             bool on_chip) {
  const auto& [graph, schedule, placement] = unit;
  const bool stalls = flow == FlowControl::stall;
  const Body body(graph, schedule, placement,
                  {.prefix = name, .enable = stalls ? "en" : "", .on_chip = on_chip});
  ModuleInterface component{name, {}};
  if (!placement.registers.empty()) component.pins.push_back({"clk", Pin::Role::clock, "", true});
  if (!placement.registers.empty() && stalls) component.pins.push_back({"en", Pin::Role::enable, "", true});
  add_data(component.pins, tests_channel, true, as_patterns(input_ports(graph)));
  add_data(component.pins, results_channel, false, output_ports(graph));
  std::string text = component.head();
  text += body.text();
  for (const Output& out : graph.outputs()) {
    text += fmt::format("  assign {} = {};\n", out.name, body.expression(out.node, schedule.stages));
  }
  text += "endmodule\n";
  for (const auto& [shape, module] : body.multipliers()) text += multiplier_module(shape, module, flow);
  return text;
}

std::string multiplier_module(const MultiplierShape& shape, const std::string& name, FlowControl flow) {
  const std::string what = fmt::format(
      "// {} x {} bits{}, {} stages; p is bits {}:{} of the product, not latched.\n", shape.width_a,
      shape.width_b, shape.is_signed ? " signed" : "", shape.stages, shape.high, shape.low);
  Graph graph = multiplier(shape, name);
  Schedule schedule = schedule_as_stated(graph, shape.stages);
  Placement placement = place_registers(graph, schedule, Ports::direct);
  return what + component_module({std::move(graph), std::move(schedule), std::move(placement)}, name, flow,
                                 shape.in_block);
}

std::string unit_module(const UnitUse& use, const std::string& name, FlowControl flow, const Library& library,
                        int clock_ps) {
  const std::string what = use.stages > 1 ? fmt::format("\n// {}: {} stages; the result is not latched.\n",
                                                        use.unit->body.name(), use.stages)
                                          : fmt::format("\n// {}: combinational.\n", use.unit->body.name());
  return what +
         component_module(divided(*use.unit, library, clock_ps), name, flow, library.chip() != nullptr);
}

/// With an interval of one cycle there is none.
std::string phase_counter(int interval, bool stalls) {
  const int width = phase_bits(interval);
  return fmt::format(
      R"(  // Stage s has a test in phase s mod {0} alone. Tests are taken in phase 0.
  reg {1}phase;
  always @(posedge clk) begin
    if (rst) phase <= {2}'d0;
    else {3}phase <= phase == {2}'d{4} ? {2}'d0 : phase + {2}'d1;
  end
)",
      interval, vector_range(width), width, stalls ? "if (advance) " : "", interval - 1);
}

/// Valid bits and tags; with stalls also what moves them.
std::string control(int last, FlowControl flow, int interval) {
  const bool stalls = flow == FlowControl::stall;
  const bool counts = interval > 1;
  const std::string ready = counts ? fmt::format("(phase == {}'d0)", phase_bits(interval)) : "";
  std::string text = fmt::format(
      "  reg [{0}:0] valid;  // by boundary: 0 the input latches, {0} the result\n"
      "  assign out_valid = valid[{0}];\n",
      last);
  if (stalls)
    text = "  // Everything moves together, or waits for out_ready.\n" + text +
           "  wire advance = out_ready | ~out_valid;\n";
  if (counts) text += phase_counter(interval, stalls);
  if (stalls || counts)
    text += fmt::format("  assign in_ready = {};\n", stalls && counts ? "advance & " + ready
                                                     : stalls         ? "advance"
                                                                      : ready);
  text += fmt::format(
      "  always @(posedge clk) begin\n"
      "    if (rst) valid <= {0}'d0;\n"
      "    else {2}valid <= {{valid[{1}:0], in_valid{3}}};\n"
      "  end\n",
      last + 1, last - 1, stalls ? "if (advance) " : "", counts ? " & in_ready" : "");
  // A register holds a tag while the test passes as many stages as the interval has cycles.
  for (int b = 0; b <= last; b += interval) text += fmt::format("  reg {} tag_s{};\n", tag_range, b);
  const char* const indent = stalls || counts ? "      " : "    ";
  std::string moves = fmt::format("{}tag_s0 <= in_tag;\n", indent);
  for (int b = interval; b <= last; b += interval)
    moves += fmt::format("{}tag_s{} <= tag_s{};\n", indent, b, b - interval);
  if (stalls || counts)
    moves = fmt::format("    if ({}) begin\n{}    end\n", counts ? "in_ready" : "advance", moves);
  return text + fmt::format("  always @(posedge clk) begin\n{}  end\n  assign out_tag = tag_s{};\n", moves,
                            last / interval * interval);
}

}  // namespace

std::string to_verilog(const Pipeline& pipeline, const Library& library, const VerilogOptions& options) {
  const Graph& graph = pipeline.graph;
  const int last = pipeline.schedule.stages;
  const std::string name = options.module_name.empty() ? graph.name() : options.module_name;
  const FlowControl flow = options.flow_control;
  const bool stalls = flow == FlowControl::stall;
  std::set<std::string> taken{"advance", "valid", "TAG_BITS"};
  if (pipeline.interval() > 1) taken.insert("phase");
  for (const Pin& pin : unit_interface(name, {}, {}, FlowControl::stall).pins) taken.insert(pin.name);
  Body body(graph, pipeline.schedule, pipeline.placement,
            {.prefix = name,
             .enable = stalls ? "advance" : "",
             .taken = taken,
             .on_chip = library.chip() != nullptr,
             .binding = pipeline.binding});

  std::string text =
      fmt::format("// {}{}{}: {} stages, {}.\n", name, options.bits.empty() ? "" : " ", options.bits, last,
                  pipeline.interval() == 1 ? "one test a cycle"
                                           : fmt::format("a test every {} cycles", pipeline.interval()));
  text += fmt::format(
      "// Clock of {} ps with the components of {}. HIT is latched {} cycles after the operands.\n"
      "{}// Generated by hitpipe; do not edit. A comment names the C++ line of a value; \"for\": the value "
      "has no name\n"
      "// in the C++ and is computed for the value of that line.\n",
      pipeline.schedule.clock_ps, library.name(), pipeline.latency(),
      stalls ? "" : "// Flow control: none. Nothing waits, and a result is there for one cycle.\n");
  text += unit_interface(name, described_operands(graph, options.operands),
                         described_results(graph, options.results), flow, pipeline.interval())
              .head();

  text += control(last, flow, pipeline.interval());
  text += body.text();
  text += "\n";
  for (const Output& out : graph.outputs()) {
    text += fmt::format("  assign {} = {};\n", out.name, body.expression(out.node, last + 1));
  }
  text += "endmodule\n";
  if (!body.multipliers().empty() || !body.units().empty()) {
    // One file holds the whole design, so the components follow the top module.
    text += "\n/* verilator lint_off DECLFILENAME */\n";
    for (const auto& [shape, module] : body.multipliers()) text += multiplier_module(shape, module, flow);
    for (const auto& [module, use] : body.units())
      text += unit_module(use, module, flow, library, pipeline.schedule.clock_ps);
    text += "\n/* verilator lint_on DECLFILENAME */\n";
  }
  return text;
}

}  // namespace hitpipe::rtl
