// A component of the emitted Verilog: a multiplier or a float operator in stages. Beside it are the
// combinational form that it must equal, and the model that replaces it in a proof of the whole design. From
// operands to result there are `edges` clock edges, all enabled where the component has an enable.
#pragma once

#include <string>
#include <vector>

#include "rtl_gen/catalogue/design.hpp"
#include "rtl_gen/component/product.hpp"
#include "rtl_gen/pipeline.hpp"
#include "rtl_gen/verilog/body.hpp"
#include "rtl_gen/verilog/module_interface.hpp"

namespace hitpipe::formal {

/// The symbol for a float operator, or "uf_mul" for the product of two 64-bit words.
struct Symbol {
  std::string name;
  int operand_bits, result_bits;
  friend auto operator<=>(const Symbol&, const Symbol&) = default;
};
[[nodiscard]] int operand_bits(const rtl::Submodule& unit);
[[nodiscard]] Symbol product_symbol();
/// An empty module whose output is the symbol applied to a and b, for yosys's write_smt2.
[[nodiscard]] std::string symbol_module(const Symbol& symbol);
/// The SMT-LIB declaration.
[[nodiscard]] std::string symbol_declaration(const Symbol& symbol);

struct Component {
  std::string module;          ///< in the emitted design
  std::string reference;       ///< name of the combinational module
  std::string reference_text;  ///< Verilog
  std::string model_text;      ///< Verilog of `module`: symbols, and one latch for each of its stages
  Symbol symbol;
  std::string axioms;  ///< Verilog: what the proof may assume about uf_mul, for operands a and b
  std::vector<rtl::Port> inputs;
  rtl::Port output;
  int edges;
  bool has_enable;  ///< and there are edges
};

/// The components of a design, by the names of their modules.
[[nodiscard]] std::vector<Component> components(const rtl::Pipeline& pipeline, const std::string& design,
                                                rtl::FlowControl flow = rtl::FlowControl::stall);

}  // namespace hitpipe::formal
