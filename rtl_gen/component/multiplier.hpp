// How a pipelined multiplier is divided into its stages. The partition is stated here, so nothing is left to
// retiming. Stage 1 multiplies the whole left operand by each of S equal pieces of the right operand. Stage
// i > 1 adds the product of piece i-1, shifted to its place, to the sum of the lower ones. The low bits of a
// sum are final and do not pass through the next adder.
#pragma once

#include "rtl_gen/graph/graph.hpp"

namespace hitpipe::rtl {

struct MultiplierShape {
  int width_a = 0;
  int width_b = 0;
  bool is_signed = false;
  int stages = 1;
  int high = 0;  ///< bits high..low of the product leave the component
  int low = 0;
  /// A multiplier block of a chip: stage 1 multiplies, and the other stages only hold the product.
  bool in_block = false;

  friend auto operator<=>(const MultiplierShape&, const MultiplierShape&) = default;
};

/// Inputs a and b, output p = bits high..low of a * b. Every node states its stage. There are 1 to width_b
/// stages, or any number in a block.
[[nodiscard]] Graph multiplier(const MultiplierShape& shape, std::string_view name);

}  // namespace hitpipe::rtl
