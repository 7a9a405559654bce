// What Table 7.2 of the thesis prints of a design, and the habits of its own with which it counts
// (section 7.5).
#pragma once

#include <vector>

#include "rtl_gen/catalogue/format.hpp"

namespace hitpipe::rtl {

struct PrintedRow {
  int row;  ///< of the table, from 1
  Format format;
};

struct Printed {
  std::vector<PrintedRow> rows{};
  bool input_latches = false;        ///< the words of figure 7.1 are counted
  bool products_at_n_bits = false;   ///< latches of products have n bits, though t > n bits are compared
  bool side_relations_at_t = false;  ///< q - p and its comparator have t bits, though they need t+1
};

}  // namespace hitpipe::rtl
