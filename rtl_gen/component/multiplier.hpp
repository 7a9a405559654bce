// How a pipelined multiplier is divided into its stages: the partition is stated here, nothing is left to
// retiming. Stage 1 multiplies the whole left operand by each of S equal pieces of the right one; stage i > 1
// adds piece i-1, already in place, to the sum of the lower ones. Low bits of a sum are final and pass by the
// adders.
#pragma once

#include "rtl_gen/graph/graph.hpp"

namespace hitpipe::rtl {

struct MultiplierShape {
  int width_a = 0;
  int width_b = 0;
  bool is_signed = false;
  int stages = 1;
  int high = 0;  ///< product bits that leave the component
  int low = 0;

  friend auto operator<=>(const MultiplierShape&, const MultiplierShape&) = default;
};

/// Inputs a, b; output p = bits high..low of a * b; every node states its stage. stages 1 to width_b.
[[nodiscard]] Graph multiplier(const MultiplierShape& shape, std::string_view name);

}  // namespace hitpipe::rtl
