// How products are made. For a library of cells a pipelined multiplier is divided into its stages; the
// partition is stated here, so nothing is left to retiming. Stage 1 multiplies the whole left operand by each
// of S equal pieces of the right operand. Stage i > 1 adds the product of piece i-1, shifted to its place, to
// the sum of the pieces below it. The low bits of a sum are final and do not pass through the next adder.
//
// On a chip a product that a multiplier block can make is one block. A larger one is cut into pieces: blocks,
// and rows of gates with adders for odd bits where those take fewer lookup tables than a block is worth. The
// pieces and their sums are nodes of the graph, so the schedule, the registers, the Verilog and the price see
// them as any other logic.
#pragma once

#include <memory>

#include "rtl_gen/component/library.hpp"
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

/// The operands of a product: their widths, and which is two's complement.
struct ProductShape {
  int width_a = 0;
  int width_b = 0;
  bool a_signed = false;
  bool b_signed = false;

  [[nodiscard]] int width() const { return width_a + width_b; }
  friend auto operator<=>(const ProductShape&, const ProductShape&) = default;
};

/// How a product is made: in one of these ways, of one or two smaller products.
struct ProductPlan {
  enum class Way {
    block,  ///< one multiplier block
    rows,   ///< one row of gates for each bit of the narrower operand, and adders
    cut_a,  ///< the low `cut` bits of a, without a sign, and the rest: two products and an adder
    cut_b,
  };
  Way way = Way::rows;
  int cut = 0;
  std::shared_ptr<const ProductPlan> low{};
  std::shared_ptr<const ProductPlan> high{};
  int blocks = 0;
  int luts = 0;  ///< by the chip's laws
};

/// The plan that takes the fewest lookup tables. A block counts as the lookup tables that it is worth. A
/// product that fits a block is always one block.
[[nodiscard]] ProductPlan plan_product(const ProductShape& shape, const Chip& chip);

/// The product of `a` and `b`, shape.width() bits, made as planned.
NodeId record_product(Graph& to, const ProductPlan& plan, const ProductShape& shape, NodeId a, NodeId b);

/// The graph with every product made as planned, for the chip of the library. A product that the source makes
/// of two halves is one first, if a block can make it. Without a chip it is the same graph. In a unit that
/// takes a test every `interval` cycles as many products share a block, so each pays that part of it.
[[nodiscard]] Graph with_products_planned(const Graph& graph, const Library& library, int interval = 1);

}  // namespace hitpipe::rtl
