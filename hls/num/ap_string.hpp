// Text of an ap_int, for programs that use ap_int as a library: no pipeline needs it. x.to_string(radix):
//   radix 10      the value, with a minus sign where it is negative
//   radix 2, 8, 16   the W bits as they are stored, all digits, after "0b", "0o" or "0x"
#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>

#include "hls/num/ap_int.hpp"

namespace hitpipe::hls {

/// Throws std::runtime_error for another radix.
template <int W, bool S>
constexpr auto ap_base<W, S>::to_string(int radix) const {
  const int digit_bits = radix == 2 ? 1 : radix == 8 ? 3 : radix == 16 ? 4 : 0;
  if (digit_bits == 0 && radix != 10) {
    throw std::runtime_error("ap_int::to_string: radix " + std::to_string(radix) +
                             ", allowed are 2, 8, 10 and 16");
  }
  const auto digit = [](int d) { return static_cast<char>(d < 10 ? '0' + d : 'a' + d - 10); };
  std::string text;
  if (radix == 10) {
    const word_type magnitude = sign() ? word_type{} - word_ : word_;
    auto rest = ap_uint<W>::wrapped(magnitude);
    do {
      text += digit((rest % ap_uint<4>(10)).to_int());
      rest /= ap_uint<4>(10);
    } while (!rest.is_zero());
    if (sign()) text += '-';
  } else {
    auto rest = ap_uint<W>(*this);
    for (int used = 0; used < W; used += digit_bits) {
      text += digit((rest & ap_uint<4>((1 << digit_bits) - 1)).to_int());
      rest >>= digit_bits;
    }
    text += radix == 2 ? 'b' : radix == 8 ? 'o' : 'x';
    text += '0';
  }
  std::reverse(text.begin(), text.end());
  return text;
}

}  // namespace hitpipe::hls
