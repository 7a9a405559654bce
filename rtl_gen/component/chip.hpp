// What a programmable chip has: lookup tables, carry chains, registers and multiplier blocks, each with its
// delay and with the lookup tables that a bit takes. Delays include the wires of a usual net.
#pragma once

#include <optional>
#include <string>

namespace hitpipe::rtl {

/// A multiplier in silicon.
struct Block {
  std::string name;  ///< the maker's, for example "DSP48E1"
  int width_a = 0;   ///< of signed operands; not less than width_b
  int width_b = 0;
  bool reads_unsigned =
      false;  ///< also multiplies unsigned operands of these widths; else they are one bit narrower
  bool operand_registers = false;  ///< the registers before it may lie in the block
  bool product_registers = false;  ///< and those behind it
  int stages = 1;
  int delay_ps = 0;  ///< of the slowest stage
  int luts = 0;      ///< an odd piece of a product takes a block only if logic would take more than these

  /// Whether one block multiplies operands of these widths. If one operand is signed, the other is read as
  /// signed with a zero above it.
  [[nodiscard]] bool multiplies(int a, bool a_signed, int b, bool b_signed) const;
};

struct Chip {
  std::string device;
  bool estimated = false;  ///< the delays
  int lut_inputs = 0;
  int register_delay_ps = 0;  ///< clock to output, and setup
  int gate_delay_ps = 0;
  int mux_delay_ps = 0;
  int carry_delay_ps = 0;          ///< of an adder or comparator without bits
  int carry_delay_ps_per_bit = 0;  ///< and what each bit adds
  int gate_luts_pct = 0;  ///< lookup tables for 100 bits; less than 100 where tables take several gates
  int mux_luts_pct = 0;
  int carry_luts_pct = 0;
  std::optional<Block> block;

  /// An adder, subtractor or comparator.
  [[nodiscard]] int carry_delay(int bits) const { return carry_delay_ps + carry_delay_ps_per_bit * bits; }
  [[nodiscard]] int gate_luts(int bits) const { return rounded_up(bits * gate_luts_pct); }
  [[nodiscard]] int mux_luts(int bits) const { return rounded_up(bits * mux_luts_pct); }
  [[nodiscard]] int carry_luts(int bits) const { return rounded_up(bits * carry_luts_pct); }

 private:
  [[nodiscard]] static int rounded_up(int percent) { return (percent + 99) / 100; }
};

}  // namespace hitpipe::rtl
