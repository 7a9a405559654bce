// What the divisions of a ray's set-up cost: a machine that makes a bit of the quotient in each cycle, by
// restoring division. A pipeline of as many subtracters does as many times the work with as many times the
// area, so area times time is the same.
#pragma once

#include <cstdint>

#include "rtl_gen/component/library.hpp"

namespace hitpipe::area {

/// Of a ray; a quotient has a remainder too, which tells how it rounds each way.
struct Divisions {
  int count = 0;
  int quotient_bits = 0;
  int divisor_bits = 24;  ///< of a binary32's mantissa
};

struct DividerPrice {
  int clock_ps = 0;  ///< of a bit
  std::int64_t area_um2 = 0;
  std::int64_t luts = 0;  ///< on a chip
};

/// Throws as area::price() of a machine does.
[[nodiscard]] DividerPrice divider_price(const Divisions& divisions, const rtl::Library& library);

}  // namespace hitpipe::area
