// The functions of a pipeline that are the same in every value domain. Each domain has its own versions of
// the functions below; the types of the values select them.
//   D::lit(v, w)            a constant: the low w bits of v, unsigned
//   width_of(x)             the width of x
//   slice(x, high, low)     bits high .. low of x, unsigned
//   cat(a, b)               a in the high bits, b in the low bits, unsigned
//   resize(x, w)            x in w bits: extended by its own sign, or its low w bits
//   as_signed(x)            the bits of x as two's complement; as_unsigned(x) the reverse
//   select(bit, a, b)       a multiplexer: a where the bit is 1, else b; a and b of one width and sign
//   as(name, x)             x, named in a traced graph; as(name, 'x', x) names it name_x
// A width is a Width<N> where D's types carry their widths (Native, Vendor), else an int (Sized, Trace).
#pragma once

#include <cstdint>

#include "hls/num/width.hpp"

namespace hitpipe {
namespace hls {

/// The types of domain D for a width of type W: Width<N> or int.
template <class D, class W>
struct WordTypes {
  using Unsigned = typename D::uint;
  using Signed = typename D::sint;
};
template <class D, int N>
struct WordTypes<D, Width<N>> {
  using Unsigned = typename D::template uint<N>;
  using Signed = typename D::template sint<N>;
};
template <class D, class W>
using Word = typename WordTypes<D, W>::Unsigned;
template <class D, class W>
using SignedWord = typename WordTypes<D, W>::Signed;

/// Bit i of x.
template <class X, class I>
constexpr auto bit_at(const X& x, const I& i) {
  return slice(x, i, i);
}

/// The top bit of x. In two's complement it is 1 if x is negative.
template <class X>
constexpr auto sign(const X& x) {
  return bit_at(x, width_of(x) - 1_w);
}

/// 1 if any bit of x is 1.
template <class D, class X>
constexpr typename D::bit any(const X& x) {
  return typename D::bit(as_unsigned(x) != D::lit(0, width_of(x)));
}

/// A bit repeated w times.
template <class Bit, class W>
constexpr auto spread(const Bit& bit, const W& w) {
  return as_unsigned(resize(as_signed(bit), w));
}

/// A word whose low `width` bits are 1, 0 <= width <= 64.
constexpr std::uint64_t low_mask(int width) {
  return width == 0 ? 0 : ~std::uint64_t{0} >> (64 - width);
}
/// The low `width` bits of a word as two's complement, 0 <= width <= 64. They are 0 if there are none.
constexpr std::int64_t sign_extended(std::uint64_t word, int width) {
  return width == 0 ? 0 : static_cast<std::int64_t>(word << (64 - width)) >> (64 - width);
}

}  // namespace hls
}  // namespace hitpipe
