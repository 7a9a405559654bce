// Writes what the proof of one fitted design reads: emit_fitted DESIGN FORMAT SET FOLDER. SET is the number
// of a demand set, from 0, or the manifest of a fitted unit. The proof: for all operands that meet the
// demands, three graphs give the same HIT. These are the traced graph, the fitted one behind the ports of the
// whole design, and the fitted one itself. docs/fit.md says which lemmas it uses.
#include <algorithm>
#include <exception>
#include <iostream>

#include <fmt/format.h>

#include "host/files.hpp"
#include "rtl_gen/emit/files.hpp"
#include "rtl_gen/graph/canonical.hpp"
#include "rtl_gen/prune/check_block.hpp"
#include "rtl_gen/prune/facts.hpp"
#include "rtl_gen/prune/prune.hpp"
#include "rtl_gen/verilog/body.hpp"
#include "tests/formal/combinational.hpp"
#include "tests/formal/component.hpp"
#include "tests/formal/fitted_set.hpp"
#include "tests/rtl_gen/prune/all_ports.hpp"

namespace {

using namespace hitpipe;

/// A product, or a call of a float operator that is simplified inside or whose result is partly known. The
/// proof may use these facts when the operands are as the analysis says.
struct Lemma {
  std::string unit;  ///< empty: a product
  rtl::Facts a, b, result;
};

/// The operator that a simplified one was made of; the operator itself if it is whole.
std::string whole_of(const std::string& unit) {
  return unit.substr(0, unit.find("_cut"));
}

/// Makes the operands of each one outputs of the graph: "a_0", "b_0", "a_1" and so on. For a call the result
/// too.
std::vector<Lemma> expose(rtl::Graph& graph, const rtl::Demands& demands) {
  const std::vector<rtl::Facts> facts = rtl::analyse(graph, demands);
  std::vector<Lemma> lemmas;
  for (rtl::NodeId id = 0; id < graph.size(); ++id) {
    const bool calls = graph[id].op == rtl::Op::call;
    const auto tells = [&](const std::string& unit) {
      return whole_of(unit) != unit || (facts[id].zeros() | facts[id].ones()) != 0;
    };
    if (calls ? !tells(graph.submodule_of(id)->body.name()) : graph[id].op != rtl::Op::mul) continue;
    const auto [a, b, unused] = graph[id].args;
    graph.output(fmt::format("a_{}", lemmas.size()), a);
    graph.output(fmt::format("b_{}", lemmas.size()), b);
    if (calls) graph.output(fmt::format("r_{}", lemmas.size()), id);
    lemmas.push_back({calls ? graph.submodule_of(id)->body.name() : "", facts[a], facts[b], facts[id]});
  }
  return lemmas;
}

/// Verilog: a value, sign-extended to 64 bits, satisfies the facts.
std::string known(const std::string& wire, const rtl::Facts& facts) {
  if (facts.width() > 64) throw std::runtime_error("a fact of more than 64 bits is not proved");
  return fmt::format("({0} >= 64'sh{1:x} && {0} <= 64'sh{2:x} && ({0} & 64'h{3:x}) == 64'h{4:x})", wire,
                     static_cast<std::uint64_t>(facts.number().low),
                     static_cast<std::uint64_t>(facts.number().high), facts.zeros() | facts.ones(),
                     facts.ones());
}

std::string signed_wire(const std::string& name, int width) {
  return fmt::format("  wire signed [{1}:0] {0}_bits;\n  wire signed [63:0] {0} = {0}_bits;\n", name,
                     width - 1);
}

/// An instance of a graph with its lemmas: wires, the instance, assertions about operands, assumptions about
/// results.
struct Instance {
  std::string text;
  std::string properties;
};

Instance instance(const std::string& module, const rtl::Graph& graph, const std::vector<Lemma>& lemmas) {
  Instance made;
  std::string ports;
  for (const rtl::Port& port : rtl::input_ports(graph))
    ports += fmt::format(".{0}({0}[{1}:0]), ", port.name, port.width - 1);
  for (std::size_t i = 0; i < lemmas.size(); ++i) {
    const Lemma& lemma = lemmas[i];
    const std::string a = fmt::format("{}_a_{}", module, i);
    const std::string b = fmt::format("{}_b_{}", module, i);
    const std::string r = fmt::format("{}_r_{}", module, i);
    made.text += signed_wire(a, lemma.a.width()) + signed_wire(b, lemma.b.width());
    ports += fmt::format(".a_{0}({1}_bits), .b_{0}({2}_bits), ", i, a, b);
    if (lemma.unit.empty()) {
      made.text +=
          fmt::format("  wire signed [63:0] {0};\n  uf_mul of_{0} (.a({1}), .b({2}), .y({0}));\n", r, a, b);
    } else {
      made.text += signed_wire(r, lemma.result.width());
      ports += fmt::format(".r_{}({}_bits), ", i, r);
    }
    const std::string operands = known(a, lemma.a) + " && " + known(b, lemma.b);
    made.properties +=
        fmt::format("    assert ({0});\n    assume (!({0}) || {1});\n", operands, known(r, lemma.result));
    const int zeros = lemma.a.low_zeros() + lemma.b.low_zeros();
    if (!lemma.unit.empty() || zeros == 0) continue;
    made.text += fmt::format(
        "  wire signed [63:0] above_{0};\n  uf_mul above_of_{0} (.a({1} >>> {2}), .b({3} >>> {4}), "
        ".y(above_{0}));\n",
        r, a, lemma.a.low_zeros(), b, lemma.b.low_zeros());
    made.properties += fmt::format("    assume (!({0}) || {1} == above_{1} << {2});\n", operands, r, zeros);
  }
  made.text += fmt::format("  wire {0}_hit;\n  {0} of_{0} ({1}.hit({0}_hit));\n", module, ports);
  return made;
}

/// The lemmas of calls, proved for the operators' own logic. A simplified operator's result is that of the
/// whole one.
std::string lemma_module(const std::vector<Lemma>& lemmas) {
  std::string text = "module lemmas (\n  input wire unused";
  std::string body;
  std::string properties;
  for (std::size_t i = 0; i < lemmas.size(); ++i) {
    const Lemma& lemma = lemmas[i];
    if (lemma.unit.empty()) continue;
    for (const char* const port : {"a", "b"})
      text += fmt::format(",\n  input wire signed [{}:0] {}_{}_bits", lemma.a.width() - 1, port, i);
    for (const char* const port : {"a", "b"})
      body += fmt::format("  wire signed [63:0] {0}_{1} = {0}_{1}_bits;\n", port, i);
    body += signed_wire(fmt::format("r_{}", i), lemma.result.width());
    const char* const result = lemma.unit.find("subtract") != std::string::npos   ? "difference"
                               : lemma.unit.find("multiply") != std::string::npos ? "product"
                                                                                  : "order";
    const std::string whole = whole_of(lemma.unit);
    body += fmt::format("  plain_{1} call_{0} (.a(a_{0}_bits), .b(b_{0}_bits), .{2}(r_{0}_bits));\n", i,
                        whole, result);
    if (whole != lemma.unit) {
      body += signed_wire(fmt::format("cut_{}", i), lemma.result.width());
      body += fmt::format("  kept_{1} cut_call_{0} (.a(a_{0}_bits), .b(b_{0}_bits), .{2}(cut_{0}_bits));\n",
                          i, lemma.unit, result);
      properties +=
          fmt::format("    assert (!({} && {}) || cut_{} == r_{});\n", known(fmt::format("a_{}", i), lemma.a),
                      known(fmt::format("b_{}", i), lemma.b), i, i);
    }
    properties +=
        fmt::format("    assume ({} && {});\n    assert ({});\n", known(fmt::format("a_{}", i), lemma.a),
                    known(fmt::format("b_{}", i), lemma.b), known(fmt::format("r_{}", i), lemma.result));
  }
  if (properties.empty()) return "";
  return text + "\n);\n" + body + "  always @* begin\n" + properties + "    cover (1);\n  end\nendmodule\n";
}

std::string miter(const rtl::Graph& traced, const Instance& plain, const Instance& kept,
                  const Instance& fitted, const rtl::Demands& demands) {
  std::string text = "module fits (\n  input wire unused";
  for (const rtl::Port& port : rtl::input_ports(traced))
    text += fmt::format(",\n  input wire [{}:0] {}", port.width - 1, port.name);
  std::string asked;
  for (const rtl::Port& port : rtl::input_ports(traced)) {
    const auto named = [&](const auto& d) { return d.port == port.name; };
    const auto ordered = [&](const auto& d) { return d.lesser == port.name || d.greater == port.name; };
    if (std::any_of(demands.ports.begin(), demands.ports.end(), named) ||
        std::any_of(demands.orders.begin(), demands.orders.end(), ordered))
      asked += fmt::format(".{0}({0}), ", port.name);
  }
  return text + fmt::format(
                    "\n);\n  wire error;\n  outside demands ({}.error(error));\n{}{}{}"
                    "  always @* begin\n    assume (!error);\n{}{}    assert (kept_hit == plain_hit);\n"
                    "    assert (fitted_hit == plain_hit);\n    cover (plain_hit);\n    cover (!plain_hit);\n"
                    "  end\nendmodule\n",
                    asked, plain.text, kept.text, fitted.text, plain.properties, kept.properties);
}

std::vector<rtl::File> files_of(const std::string& name, const std::string& bits, const std::string& set) {
  const rtl::Design& design = rtl::find_design(name);
  const hitpipe::Format format = design.parse_format(bits);
  const rtl::Graph traced = design.trace(format);
  const rtl::DemandSet fit = formal::fitted_set(design, format, set);
  const rtl::Graph fitted = rtl::prune(traced, fit.demands, {.shares = false}).graph;
  rtl::Graph kept = rtl::with_all_ports(fitted, rtl::input_ports(traced));
  rtl::Graph plain = rtl::canonical(traced);
  const std::vector<Lemma> of_plain = expose(plain, fit.demands);
  const std::vector<Lemma> of_kept = expose(kept, fit.demands);
  std::vector<Lemma> lemmas = of_plain;
  lemmas.insert(lemmas.end(), of_kept.begin(), of_kept.end());

  std::string models;
  std::string modules = formal::symbol_module(formal::product_symbol());
  std::string declarations = formal::symbol_declaration(formal::product_symbol());
  for (const auto& unit : traced.submodules()) {
    const rtl::Output& result = unit->body.outputs().front();
    const formal::Symbol symbol{fmt::format("uf_{}", unit->body.name()), formal::operand_bits(*unit),
                                unit->body[result.node].width};
    modules += formal::symbol_module(symbol);
    declarations += formal::symbol_declaration(symbol);
  }
  const auto add_models = [&](const char* top, const rtl::Graph& graph) {
    for (const auto& unit : graph.submodules()) {
      const rtl::Output& result = unit->body.outputs().front();
      models += fmt::format(
          "module {0}_{1} (\n  input wire {2}a, b,\n  output wire {3}{4}\n);\n"
          "  uf_{5} symbol (.a(a), .b(b), .y({4}));\nendmodule\n",
          top, unit->body.name(), rtl::vector_range(formal::operand_bits(*unit)),
          rtl::vector_range(unit->body[result.node].width), result.name, whole_of(unit->body.name()));
    }
  };
  add_models("plain", plain);
  add_models("kept", kept);
  add_models("fitted", fitted);
  return {{"plain.v", rtl::to_combinational_verilog(plain, "plain")},
          {"kept.v", rtl::to_combinational_verilog(kept, "kept")},
          {"fitted.v", rtl::to_combinational_verilog(fitted, "fitted")},
          {"demands.v", rtl::check_module("outside", fit.demands, rtl::input_ports(traced))},
          {"fits.v", miter(traced, instance("plain", plain, of_plain), instance("kept", kept, of_kept),
                           instance("fitted", fitted, {}), fit.demands)},
          {"lemmas.v", lemma_module(lemmas)},
          {"models.v", models},
          {"symbols.v", modules},
          {"symbols.smt2", declarations},
          {"set", fit.name + "\n"}};
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc != 5) throw std::runtime_error("usage: emit_fitted DESIGN FORMAT SET FOLDER");
    host::write_files(argv[4], files_of(argv[1], argv[2], argv[3]));
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return 0;
}
