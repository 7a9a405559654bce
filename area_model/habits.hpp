// How Table 7.2 departs from the schematics that it prices, design by design. Where and by how much:
// docs/table-7-2.md. Not here, as they hold in every row: only latches, muxes, subtractors, multipliers and
// comparators have area (no valid bits, no tag), and each row is rounded before the total is taken.
#pragma once

#include <string_view>

#include "rtl_gen/catalogue/format.hpp"
#include "rtl_gen/pipeline.hpp"

namespace hitpipe::area {

struct Habits {
  std::string_view design;
  bool input_latches;        ///< the words of figure 7.1 are counted
  bool products_at_n_bits;   ///< latches of products have n bits, though t > n bits are compared
  bool side_relations_at_t;  ///< q - p and its comparator have t bits, though they need t+1
};

/// Throws std::runtime_error, one line, for a design that is not the thesis's.
[[nodiscard]] const Habits& printed_habits(std::string_view design);

/// The width at which Table 7.2 prices a latch, or a component.
[[nodiscard]] int printed_latch_bits(const rtl::Graph& graph, const rtl::Register& latch, rtl::Format format,
                                     const Habits& habits);
[[nodiscard]] int printed_component_bits(const rtl::Graph& graph, rtl::NodeId node, rtl::Format format,
                                         const Habits& habits);

}  // namespace hitpipe::area
