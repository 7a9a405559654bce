// A component of the emitted Verilog, a multiplier or a float operator in stages, beside the combinational
// form that it must equal and the model that stands for it in a proof of the whole design. `edges` clock
// edges, all enabled, lead from its operands to its result.
#pragma once

#include <string>
#include <vector>

#include "rtl_gen/catalogue/design.hpp"
#include "rtl_gen/component/multiplier.hpp"
#include "rtl_gen/pipeline.hpp"
#include "rtl_gen/verilog/body.hpp"

namespace hitpipe::formal {

/// The symbol that stands for a float operator or, as "uf_mul", for the product of two 64-bit words.
struct Symbol {
  std::string name;
  int operand_bits, result_bits;
  friend auto operator<=>(const Symbol&, const Symbol&) = default;
};
[[nodiscard]] Symbol product_symbol();
/// A module without insides whose output is the symbol applied to a and b, for yosys's write_smt2.
[[nodiscard]] std::string symbol_module(const Symbol& symbol);
/// The SMT-LIB declaration.
[[nodiscard]] std::string symbol_declaration(const Symbol& symbol);

struct Component {
  std::string module;          ///< in the emitted design
  std::string reference;       ///< combinational, the name alone
  std::string reference_text;  ///< Verilog
  std::string model_text;      ///< Verilog of `module`: symbols and as many latches as it has stages
  Symbol symbol;
  std::string axioms;  ///< Verilog of what the proof may assume of uf_mul, for operands a and b
  std::vector<rtl::Port> inputs;
  rtl::Port output;
  int edges;
};

/// The components of a design, by the names of their modules.
[[nodiscard]] std::vector<Component> components(const rtl::Pipeline& pipeline, const std::string& design);

}  // namespace hitpipe::formal
