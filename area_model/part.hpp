// What a design is built of, under the names of Table 7.1: "latch_24", "int_subtract_25". Valid and tag bits,
// which the thesis does not draw, are latches with rows of their own.
#pragma once

#include <compare>
#include <string>

#include "rtl_gen/component/library.hpp"

namespace hitpipe::area {

enum class Purpose {
  datapath,
  valid,  ///< one bit a boundary: there is a ray-box pair here
  tag,    ///< which travels along
};

struct Part {
  rtl::Component component;
  int bits;
  Purpose purpose = Purpose::datapath;
  int by = 0;  ///< of a multiplier with a narrower operand: that one's width; 0: both have `bits`

  friend bool operator==(const Part&, const Part&) = default;
  /// In the order of Table 7.1, then by width; valid and tag bits last.
  friend std::strong_ordering operator<=>(const Part& a, const Part& b);
};

/// "latch_24"; of valid and tag bits "valid_1", "tag_16"; "int_multiply_24x18" with operands of two widths.
[[nodiscard]] std::string part_name(const Part& part);

}  // namespace hitpipe::area
