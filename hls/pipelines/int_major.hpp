// Integer slabs with a major axis: does a ray meet a box? The distance along the ray is counted along its
// largest direction component. On that axis a distance is a difference of coordinates. On the others it is
// the difference times a quotient of two components, at least 1, with an exponent of its own. So no
// component takes bits from another, however small it is. docs/never_misses.md proves that the unit never misses.
// Widths: differences n+g bits, products n+g+p, distances n+F+1.
#pragma once

#include "hls/box/box_hit.hpp"
#include "hls/box/format.hpp"
#include "hls/box/int_major_operands.hpp"
#include "hls/pipelines/major_parts.hpp"

namespace hitpipe {
namespace hls {
namespace int_major {
struct IntMajor {
  static constexpr const char* name = "int_major";
  static constexpr const char* summary = "integer slabs along the major axis";
  static constexpr bool conservative = true;
  static constexpr DesignKind kind = box_kind;
  static constexpr const char* header = __FILE__;
  using Bits = MajorBits;
  using BuiltIn = FormatList<MajorFormat<20, 1, 13>>;
  template <class D, class F>
  using Operands = IntMajorOperands<D, F>;
  template <class D, class F>
  using Results = BoxHit<typename D::bit>;
  /// The three intervals and [0, len] have a point in common.
  template <class D, class F>
  static constexpr Results<D, F> test(const F& format, const IntMajorOperands<D, F>& in) {
    using Bit = typename D::bit;
    const auto t = plane_distances<D, F>(format, in, in);
    const auto near = as("near", greater<Bit>(as("near_ma", greater<Bit>(t.m.near, t.a.near)), t.b.near));
    const auto far = as("far", lesser<Bit>(as("far_ma", lesser<Bit>(t.m.far, t.a.far)), t.b.far));

    const Bit behind = sign(far);
    const Bit apart = as("apart", Bit(far < near));
    const Bit beyond = as("beyond", Bit(in.len < near));
    return {as("overlap", ~behind & ~apart & ~beyond)};
  }
};

}  // namespace int_major

using int_major::IntMajor;

}  // namespace hls
}  // namespace hitpipe
