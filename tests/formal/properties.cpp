#include "tests/formal/properties.hpp"

#include <fmt/format.h>

namespace hitpipe::formal {

namespace {

using rtl::vector_range;

std::string inputs_of(const std::vector<rtl::Port>& ports) {
  std::string text;
  for (const rtl::Port& port : ports)
    text += fmt::format(",\n  input wire {}{}", vector_range(port.width), port.name);
  return text;
}

std::string connections(const std::vector<rtl::Port>& ports) {
  std::string text;
  for (const rtl::Port& port : ports) text += fmt::format(".{0}({0}), ", port.name);
  return text;
}

int result_bits(const rtl::Graph& graph) {
  int bits = 0;
  for (const rtl::Output& out : graph.outputs()) bits += graph[out.node].width;
  return bits;
}

/// All results, the first lowest, as bits of one word.
std::string results_in(const rtl::Graph& graph, const std::string& net) {
  std::string text;
  int low = 0;
  for (const rtl::Output& out : graph.outputs()) {
    const int width = graph[out.node].width;
    text += fmt::format("{}.{}({}[{}:{}])", low == 0 ? "" : ", ", out.name, net, low + width - 1, low);
    low += width;
  }
  return text;
}

/// A design and its reference on the same operands. `found` are the results; `expected` are those for the
/// operands at the ports.
std::string instances(const rtl::Pipeline& pipeline, const std::string& design, rtl::FlowControl flow) {
  const rtl::Graph& graph = pipeline.graph;
  const bool stalls = flow == rtl::FlowControl::stall;
  const bool waits = stalls || pipeline.interval() > 1;
  const std::vector<rtl::Port> ports = rtl::input_ports(graph);
  return fmt::format(
      "  wire {5}out_valid;\n  wire [{4}:0] found, expected;\n  wire [3:0] out_tag;\n"
      "  {0} #(.TAG_BITS(4)) dut (\n    .clk(clk), .rst(rst), .in_valid(in_valid), {6}"
      ".in_tag(in_tag),\n    .out_valid(out_valid), {7}.out_tag(out_tag),\n    "
      "{1}{2});\n"
      "  {0}_reference same (\n    {1}{3});\n",
      design, connections(ports), results_in(graph, "found"), results_in(graph, "expected"),
      result_bits(graph) - 1, waits ? "in_ready, " : "", waits ? ".in_ready(in_ready), " : "",
      stalls ? ".out_ready(out_ready), " : "");
}

/// An assertion for each result: it belongs to the first operands.
std::string each_result_is(const rtl::Graph& graph) {
  std::string text;
  int low = 0;
  for (const rtl::Output& out : graph.outputs()) {
    const int high = low + graph[out.node].width - 1;
    text += fmt::format("      assert (found[{0}:{1}] == first[{0}:{1}]);\n", high, low);
    low = high + 1;
  }
  return text;
}

std::string head(const char* name, const std::vector<rtl::Port>& ports) {
  return fmt::format(
      "module {} (\n  input wire clk, rst, in_valid, out_ready,\n  input wire [3:0] in_tag{}\n);\n", name,
      inputs_of(ports));
}

}  // namespace

std::string component_flow(const Component& c) {
  std::string text = fmt::format("module flow (\n  input wire clk{}\n);\n", inputs_of(c.inputs));
  const std::string range = vector_range(c.output.width);
  text += fmt::format(
      "  wire {0}found, expected;\n  {1} dut ({2}{3}.{4}(found));\n  {5} same ({3}.{4}(expected));\n", range,
      c.module, c.edges > 0 ? (c.has_enable ? ".clk(clk), .en(1'b1), " : ".clk(clk), ") : "",
      connections(c.inputs), c.output.name, c.reference);
  if (!c.axioms.empty()) text += "`ifdef PRODUCTS_ARE_SYMBOLS\n" + c.axioms + "`endif\n";
  if (c.edges == 0)
    return text +
           "  always @* begin\n    assert (found == expected);\n    cover (|found);\n  end\nendmodule\n";
  text += fmt::format(
      "  reg [7:0] edges = 0;\n  reg {}first;\n  always @(posedge clk) begin\n"
      "    edges <= edges + 8'd1;\n    if (edges == 0) first <= expected;\n  end\n"
      "  always @* if (edges == {}) begin\n    assert (found == first);\n    cover (|found);\n  "
      "end\nendmodule\n",
      range, c.edges);
  return text;
}

std::string design_flow(const rtl::Pipeline& pipeline, const std::string& design, rtl::FlowControl flow) {
  const std::vector<rtl::Port> ports = rtl::input_ports(pipeline.graph);
  const std::string moves = flow == rtl::FlowControl::stall ? "(out_ready || !out_valid) && " : "";
  const std::string taken = pipeline.interval() > 1 ? "(edges != 0 || in_ready) && " : "";
  return head("flow", ports) + instances(pipeline, design, flow) +
         fmt::format(
             "  reg [7:0] edges = 0;\n  reg [{1}:0] first;\n  reg [3:0] first_tag;\n"
             "  always @(posedge clk) begin\n    edges <= edges + 8'd1;\n"
             "    if (edges == 0) begin\n      first <= expected;\n      first_tag <= in_tag;\n    end\n  "
             "end\n"
             "  always @* begin\n    assume ({3}!rst);\n    if (edges == {0}) begin\n"
             "{2}      assert (out_tag == first_tag);\n"
             "      cover (found[0]);\n      cover (!found[0]);\n    end\n  end\nendmodule\n",
             pipeline.latency() + 1, result_bits(pipeline.graph) - 1, each_result_is(pipeline.graph),
             moves + taken);
}

std::string control_properties(const rtl::Pipeline& pipeline, rtl::FlowControl flow) {
  const bool stalls = flow == rtl::FlowControl::stall;
  const int interval = pipeline.interval();
  const int last = pipeline.schedule.stages;
  std::string shift;
  std::string equal;
  std::string declare;
  for (int b = 0; b <= last; ++b) {
    declare += fmt::format("  reg {} was_tag_{};\n", rtl::tag_range, b);
    shift += b == 0 ? std::string("      was_tag_0 <= in_tag;\n")
                    : fmt::format("      was_tag_{} <= was_tag_{};\n", b, b - 1);
    equal += fmt::format("      if (taken[{0}]) assert (tag_s{1} == was_tag_{0});\n", b, b - b % interval);
    if (interval > 1)
      equal += fmt::format("      if (taken[{}]) assert (phase == {});\n", b, (b + 1) % interval);
  }
  std::string ready = "move";
  std::string ring;  // its bit i is set after i moves since the reset, modulo the interval
  if (interval > 1) {
    ready = "move && turn[0]";
    ring = fmt::format(
        "  reg [{0}:0] turn;\n  always @(posedge clk)\n    if (rst) turn <= 1;\n"
        "    else if (move) turn <= {{turn[{1}:0], turn[{0}]}};\n",
        interval - 1, interval - 2);
    equal += fmt::format("      assert (phase < {0} && turn == ({0}'d1 << phase));\n", interval);
  }
  return fmt::format(
      "  reg was_reset = 0;\n  reg [{0}:0] taken;\n{1}  wire move = {5};\n{8}"
      "  always @(posedge clk) begin\n    was_reset <= was_reset | rst;\n    if (rst) taken <= 0;\n"
      "    else if (move) taken <= {{taken[{2}:0], in_valid{9}}};\n    if (move) begin\n{3}    end\n  end\n"
      "  always @* begin\n    if (was_reset) begin\n      assert (valid == taken);\n"
      "{6}      assert (out_valid == taken[{0}]);\n"
      "      assert (!out_valid || out_tag == was_tag_{0});\n{4}"
      "      cover (out_valid && {7}taken[{10}]);\n    end\n  end\n",
      last, declare, last - 1, shift, equal, stalls ? fmt::format("out_ready | ~taken[{}]", last) : "1'b1",
      stalls || interval > 1 ? fmt::format("      assert (in_ready == ({}));\n", ready) : "",
      stalls ? "!out_ready && " : "", ring, interval > 1 ? " && turn[0]" : "", last % interval);
}

std::string stalled_design(const rtl::Pipeline& pipeline, const std::string& design) {
  const std::vector<rtl::Port> ports = rtl::input_ports(pipeline.graph);
  return head("stalled", ports) + instances(pipeline, design, rtl::FlowControl::stall) +
         fmt::format(
             "  reg first_step = 1, given = 0;\n  reg [{1}:0] first;\n  reg [3:0] expected_tag;\n"
             "  reg [7:0] moves = 0, stalls = 0;\n  wire move = out_ready || !out_valid;\n"
             "  wire due = !first_step && moves == {0} && !given;\n"
             "  always @(posedge clk) begin\n    first_step <= 0;\n    if (first_step) begin\n"
             "      first <= expected;\n      expected_tag <= in_tag;\n    end else begin\n"
             "      moves <= moves + {{7'd0, move && !given}};\n      stalls <= stalls + {{7'd0, "
             "!move}};\n"
             "      given <= given || (due && out_ready);\n    end\n  end\n"
             "  always @* begin\n    assume (!rst && stalls <= 2);\n    if (first_step) assume (in_valid && "
             "in_ready);\n"
             "    assert ({3});\n"
             "    if (due) begin\n      assert (out_valid);\n{2}"
             "      assert (out_tag == expected_tag);\n    end\n"
             "    cover (due && found[0] && stalls >= 2);\n    cover (due && !found[0] && stalls >= 2);\n  "
             "end\nendmodule\n",
             pipeline.latency(), result_bits(pipeline.graph) - 1, each_result_is(pipeline.graph),
             pipeline.interval() > 1 ? "move || !in_ready" : "in_ready == move");
}

}  // namespace hitpipe::formal
