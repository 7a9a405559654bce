// The parts of a design, under the names of Table 7.1: "latch_24", "int_subtract_25". Valid and tag bits,
// which the thesis does not draw, are latches too and have rows of their own.
#pragma once

#include <compare>
#include <string>

#include "rtl_gen/component/library.hpp"

namespace hitpipe::area {

enum class Purpose {
  datapath,
  valid,  ///< one bit at each boundary: there is a ray-box pair
  tag,    ///< the tag at each boundary
  block,  ///< a latch that is one of the registers of a chip's multiplier block, so it costs nothing more
};

struct Part {
  rtl::Component component;
  int bits;
  Purpose purpose = Purpose::datapath;
  int by = 0;  ///< the width of a multiplier's narrower operand; 0: both operands have `bits`

  friend bool operator==(const Part&, const Part&) = default;
  /// In the order of Table 7.1, then by width; valid and tag bits last.
  friend std::strong_ordering operator<=>(const Part& a, const Part& b);
};

/// "latch_24"; "valid_1" and "tag_16" for valid and tag bits; "block_latch_24"; "int_multiply_24x18" for
/// operands of two widths.
[[nodiscard]] std::string part_name(const Part& part);

}  // namespace hitpipe::area
