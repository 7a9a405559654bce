#include "tests/formal/component.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "tests/formal/combinational.hpp"

namespace hitpipe::formal {

namespace {

using rtl::vector_range;

constexpr int word = 64;

std::string extended(const std::string& bits, int width, const std::string& fill) {
  return fmt::format("{{{{{}{{{}}}}}, {}}}", word - width, fill, bits);
}

/// Adds latches to `text` that hold `value` for `edges` clock edges, with an enable while en is high. Returns
/// the name of the last latch.
std::string delayed(std::string& text, const std::string& value, int width, int edges, bool has_enable) {
  std::string last = value;
  for (int i = 1; i <= edges; ++i) {
    const std::string next = fmt::format("delay_{}", i);
    text += fmt::format("  reg {}{};\n  always @(posedge clk) {}{} <= {};\n", vector_range(width), next,
                        has_enable ? "if (en) " : "", next, last);
    last = next;
  }
  return last;
}

std::string model(const Component& c, const std::string& operands, int high, int low) {
  std::string text =
      fmt::format("module {} (\n{}  input wire {}a,\n  input wire {}b,\n  output wire {}{}\n);\n", c.module,
                  c.edges == 0   ? ""
                  : c.has_enable ? "  input wire clk, en,\n"
                                 : "  input wire clk,\n",
                  vector_range(c.inputs.front().width), vector_range(c.inputs.back().width),
                  vector_range(c.output.width), c.output.name);
  text += fmt::format("  wire {}y;\n  {} symbol ({}, .y(y));\n", vector_range(c.symbol.result_bits),
                      c.symbol.name, operands);
  const std::string last =
      delayed(text, fmt::format("y[{}:{}]", high, low), c.output.width, c.edges, c.has_enable);
  text += fmt::format("  assign {} = {};\nendmodule\n", c.output.name, last);
  return text;
}

/// a * b as the sum of its pieces, each no wider than its operands together. The proof may use nothing else
/// about multiplication. emit_lemmas.cpp proves both facts for integers.
std::string multiplier_axioms(const rtl::MultiplierShape& shape) {
  const int piece = (shape.width_b + shape.stages - 1) / shape.stages;
  const std::string a = extended("a", shape.width_a, fmt::format("a[{}]", shape.width_a - 1));
  const std::string b = extended("b", shape.width_b, fmt::format("b[{}]", shape.width_b - 1));
  std::string text =
      fmt::format("  wire [63:0] whole;\n  uf_mul of_whole (.a({}), .b({}), .y(whole));\n", a, b);
  std::string sum;
  std::string ranges;
  for (int low = 0, i = 0; low < shape.width_b; low += piece, ++i) {
    const int high = std::min(low + piece, shape.width_b) - 1;
    const bool top = high == shape.width_b - 1;
    const int width = high - low + 1;
    const std::string factor =
        extended(fmt::format("b[{}:{}]", high, low), width, top ? fmt::format("b[{}]", high) : "1'b0");
    text += fmt::format("  wire [63:0] part_{0};\n  uf_mul of_part_{0} (.a({1}), .b({2}), .y(part_{0}));\n",
                        i, a, factor);
    sum += fmt::format("{}(part_{} << {})", i == 0 ? "" : " + ", i, low);
    const int sign = shape.width_a + width + (top ? 0 : 1) - 1;
    ranges += fmt::format("    assume (&part_{0}[63:{1}] || ~|part_{0}[63:{1}]);\n", i, sign);
  }
  return text + fmt::format("  always @* begin\n    assume (whole == {});\n{}  end\n", sum, ranges);
}

Component multiplier_component(const rtl::MultiplierShape& shape, const std::string& module,
                               bool has_enable) {
  if (!shape.is_signed)
    throw std::runtime_error(fmt::format("{}: only signed multipliers are proved", module));
  Component c{.module = module,
              .reference = fmt::format("{}_reference", module),
              .reference_text = {},
              .model_text = {},
              .symbol = product_symbol(),
              .axioms = multiplier_axioms(shape),
              .inputs = {{"a", shape.width_a, true}, {"b", shape.width_b, true}},
              .output = {"p", shape.high - shape.low + 1, true},
              .edges = shape.stages - 1,
              .has_enable = has_enable};
  c.reference_text = fmt::format(
      "module {} (\n  input wire {}a,\n  input wire {}b,\n  output wire {}p\n);\n"
      "  wire {}whole = $signed(a) * $signed(b);\n  assign p = whole[{}:{}];\nendmodule\n",
      c.reference, vector_range(shape.width_a), vector_range(shape.width_b), vector_range(c.output.width),
      vector_range(shape.width_a + shape.width_b), shape.high, shape.low);
  const std::string operands =
      fmt::format(".a({}), .b({})", extended("a", shape.width_a, fmt::format("a[{}]", shape.width_a - 1)),
                  extended("b", shape.width_b, fmt::format("b[{}]", shape.width_b - 1)));
  c.model_text = model(c, operands, shape.high, shape.low);
  return c;
}

Component unit_component(const rtl::UnitUse& use, const std::string& module, bool has_enable) {
  const rtl::Graph& body = use.unit->body;
  const rtl::NodeId result = body.outputs().front().node;
  Component c{.module = module,
              .reference = fmt::format("{}_reference", module),
              .reference_text = {},
              .model_text = {},
              .symbol = {fmt::format("uf_{}", body.name()), operand_bits(*use.unit), body[result].width},
              .axioms = {},
              .inputs = rtl::input_ports(body),
              .output = {body.outputs().front().name, body[result].width, false},
              .edges = use.stages - 1,
              .has_enable = has_enable};
  c.reference_text = rtl::to_combinational_verilog(body, c.reference);
  c.model_text = model(c, ".a(a), .b(b)", c.output.width - 1, 0);
  return c;
}

}  // namespace

int operand_bits(const rtl::Submodule& unit) {
  return unit.body[unit.body.inputs().front()].width;
}

Symbol product_symbol() {
  return {"uf_mul", word, word};
}

std::string symbol_module(const Symbol& s) {
  return fmt::format(
      "(* smtlib2_module *)\nmodule {0} (\n  input wire {1}a, b,\n"
      "  (* smtlib2_comb_expr = \"({0} a b)\" *) output wire {2}y\n);\nendmodule\n",
      s.name, vector_range(s.operand_bits), vector_range(s.result_bits));
}

std::string symbol_declaration(const Symbol& s) {
  // Sorts by name: yosys-smtbmc cannot unroll a function whose operand sort is an expression.
  return fmt::format(
      "(define-sort {0}_operand () (_ BitVec {1}))\n"
      "(declare-fun {0} ({0}_operand {0}_operand) (_ BitVec {2}))\n",
      s.name, s.operand_bits, s.result_bits);
}

std::vector<Component> components(const rtl::Pipeline& pipeline, const std::string& design,
                                  rtl::FlowControl flow) {
  const bool stalls = flow == rtl::FlowControl::stall;
  const rtl::Body body(pipeline.graph, pipeline.schedule, pipeline.placement,
                       {.prefix = design, .enable = stalls ? "advance" : "", .binding = pipeline.binding});
  std::vector<Component> found;
  for (const auto& [shape, module] : body.multipliers())
    found.push_back(multiplier_component(shape, module, stalls));
  for (const auto& [module, use] : body.units()) found.push_back(unit_component(use, module, stalls));
  return found;
}

}  // namespace hitpipe::formal
