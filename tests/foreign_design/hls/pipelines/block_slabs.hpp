// A slabs test of endless rays against boxes with one exponent for all planes. The planes are shifted to the
// ray's grid. A direction has one bound r of its scaled inverse, which lies in r..r+1. Each distance takes
// the bound that makes the interval longer, so the test is conservative.
#pragma once

#include "hls/box/block_slabs_operands.hpp"
#include "hls/box/box_hit.hpp"
#include "hls/num/bits.hpp"
#include "hls/num/levels.hpp"

namespace hitpipe {
namespace hls {
namespace block_slabs {

struct BlockSlabs {
  static constexpr const char* name = "block_slabs";
  static constexpr const char* summary = "slabs test of boxes with one exponent";
  static constexpr DesignKind kind = box_kind;
  static constexpr const char* header = __FILE__;
  static constexpr bool conservative = true;

  using Bits = BlockBits;
  using BuiltIn = FormatList<>;
  template <class D, class F>
  using Operands = BlockSlabsOperands<D, F>;
  template <class D, class F>
  using Results = BoxHit<typename D::bit>;

  template <class D, class F>
  static constexpr Results<D, F> test(const F& format, const BlockSlabsOperands<D, F>& in) {
    using Word = typename D::sint;
    using Bit = typename D::bit;
    /// mantissa << exponent, in N bits.
    const auto plane = [&](char axis, const Word& mantissa) {
      return as("plane", axis,
                for_each_level(format.exponent(), resize(mantissa, format.coord),
                               [&](const Word& word, const auto& level) {
                                 const auto amount = power_of_two(level);
                                 const Word moved = as_signed(
                                     cat(slice(word, format.coord - 1_w - amount, 0_w), D::lit(0, amount)));
                                 return select(bit_at(in.exponent, level), moved, word);
                               }));
    };
    /// One of the two bounds of the distance d to a plane.
    const auto distance = [&](const char* part, char axis, const Word& d, const Word& r, bool far) {
      const Word more = as("r1", axis, r - as_signed(D::lit(1, 1_w)));
      const Word less = resize(r, format.coord + 1_w);
      const Bit positive = ~sign(d);
      const Word bound = far ? select(positive, more, less) : select(positive, less, more);
      return as(part, axis, as_signed(slice(d * bound, format.product() - 1_w, format.coord - 1_w)));
    };
    const auto slab = [&](char axis, const Word& origin, const Word& low, const Word& high, const Word& r) {
      const Word to_low = as("to_low", axis, resize(plane(axis, low) - origin, format.coord));
      const Word to_high = as("to_high", axis, resize(plane(axis, high) - origin, format.coord));
      const Bit backward = sign(r);
      return Interval<Word>{distance("near", axis, select(backward, to_high, to_low), r, false),
                            distance("far", axis, select(backward, to_low, to_high), r, true)};
    };
    const auto x = slab('x', in.rx, in.xmin, in.xmax, in.inv_x);
    const auto y = slab('y', in.ry, in.ymin, in.ymax, in.inv_y);
    const auto z = slab('z', in.rz, in.zmin, in.zmax, in.inv_z);
    const auto greatest = [](const Word& a, const Word& b) { return select(Bit(a < b), b, a); };
    const auto least = [](const Word& a, const Word& b) { return select(Bit(b < a), b, a); };
    const Word near = as("near", greatest(greatest(x.near, y.near), z.near));
    const Word far = as("far", least(least(x.far, y.far), z.far));
    return {as("ahead", ~sign(far) & ~Bit(far < near))};
  }

 private:
  template <class Word>
  struct Interval {
    Word near, far;
  };
};

}  // namespace block_slabs

using block_slabs::BlockSlabs;

}  // namespace hls
}  // namespace hitpipe
