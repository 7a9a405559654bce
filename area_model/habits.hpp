// How Table 7.2 departs from the schematics that it prices, design by design; docs/table-7-2.md tells where
// and by how much. Two habits hold in every row and are not listed here: only latches, muxes, subtractors,
// multipliers and comparators have area (valid and tag bits have none), and each row is rounded before the
// total is taken.
#pragma once

#include <string_view>

#include "rtl_gen/catalogue/format.hpp"
#include "rtl_gen/pipeline.hpp"

namespace hitpipe::area {

struct Habits {
  std::string_view design;
  bool input_latches;        ///< the words of figure 7.1 are counted
  bool products_at_n_bits;   ///< latches of products count n bits, though t > n bits are compared
  bool side_relations_at_t;  ///< q - p and its comparator count t bits, though they need t+1
};

/// Throws std::runtime_error, one line, for a design that is not in the thesis.
[[nodiscard]] const Habits& printed_habits(std::string_view design);

/// The width at which Table 7.2 prices a latch or a component.
[[nodiscard]] int printed_latch_bits(const rtl::Graph& graph, const rtl::Register& latch, rtl::Format format,
                                     const Habits& habits);
[[nodiscard]] int printed_component_bits(const rtl::Graph& graph, rtl::NodeId node, rtl::Format format,
                                         const Habits& habits);

}  // namespace hitpipe::area
