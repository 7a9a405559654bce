// The integer Pluecker test of section 6.3.2, figures 7.11 to 7.14: the ray passes inside the box's
// silhouette and the box lies between its ends, in n-bit coordinates. Conservative: the direction is known to
// half a unit and products lose their low bits, so a side relation counts as outside only below EBND. Says
// HIT too often, never too seldom. Widths: differences n bits, products 2n, of which t are kept, side
// relations t+1 (the thesis prices t).
#pragma once

#include <cstdint>

#include "hls/box/arithmetic.hpp"
#include "hls/box/int_format.hpp"
#include "hls/box/int_plucker_operands.hpp"
#include "hls/pipelines/plucker_parts.hpp"

namespace hitpipe::hls {

/// EBND, the smallest side relation of a ray that passes inside an edge: -ceil((2^(n-1)-2) / 2^k) with
/// k = 2n-1-t dropped bits; proved in sw_ref/quantise/int_plucker_ray.cpp. -1 at 24/24, -16 at 20/24.
constexpr std::int64_t edge_bound(IntBits bits) {
  const std::int64_t largest = (std::int64_t{1} << (bits.coord - 1)) - 2;
  const std::int64_t unit = std::int64_t{1} << bits.trimmed();
  return -((largest + unit - 1) >> bits.trimmed());
}

/// Planes less the origin: stage 1, figure 7.12.
template <class Bit, class Coord>
constexpr AxisView<Bit, Coord> int_axis_view(char axis, const Coord& direction, const Coord& origin,
                                             const Coord& plane_min, const Coord& plane_max) {
  constexpr int n = Coord::width;
  const Coord a = as("a", axis, resize<n>(plane_min - origin));
  const Coord b = as("b", axis, resize<n>(plane_max - origin));
  return {direction, Bit(slice<n - 1, n - 1>(direction)), a, b};
}

/// A term of a side relation, its low bits dropped: bits 2n-2 down to 2n-1-t of the product.
template <class Interval, class Coord>
constexpr Interval side_term(const char* name, char number, const SideFactors<Coord>& factors) {
  constexpr int product = 2 * Coord::width - 1;
  const auto whole = factors.direction * factors.plane;
  return as(name, number, Interval(slice<product - 1, product - Interval::width>(whole)));
}

/// The side relation of ray and edge is below EBND: figures 7.13 and 7.14.
template <class D, class F, class Coord>
constexpr typename D::bit int_outside(char number, const SilhouetteEdge<Coord>& edge) {
  using Interval = typename D::template sint<F::interval>;
  using Side = typename D::template sint<F::interval + 1>;
  const Interval q = side_term<Interval>("q", number, edge.q);
  const Interval p = side_term<Interval>("p", number, edge.p);
  const Side side = as("side", number, Side(q - p));
  return as("outside", number, typename D::bit(side < Side(edge_bound(F::bits))));
}

struct IntPlucker {
  static constexpr const char* name = "int_plucker";
  static constexpr const char* summary = "integer Pluecker test, figures 7.11-7.14";
  static constexpr Arithmetic arithmetic = Arithmetic::integer;
  static constexpr bool conservative = true;
  using Bits = IntBits;

  template <class D, class F>
  using Operands = IntPluckerOperands<D, F>;

  template <class D, class F>
  static constexpr typename D::bit hit(const Operands<D, F>& in) {
    using Bit = typename D::bit;
    using Coord = typename Operands<D, F>::coord;
    const auto compare = [](const Coord& a, const Coord& b) { return int_compare<Bit>(a, b); };
    const auto x = int_axis_view<Bit>('x', in.iri, in.irx, in.ixmin, in.ixmax);
    const auto y = int_axis_view<Bit>('y', in.irj, in.iry, in.iymin, in.iymax);
    const auto z = int_axis_view<Bit>('z', in.irk, in.irz, in.izmin, in.izmax);
    const Bit extent =
        within_extent(axis_extent('x', x.minus, in.irx, in.irex, in.ixmin, in.ixmax, compare),
                      axis_extent('y', y.minus, in.iry, in.irey, in.iymin, in.iymax, compare),
                      axis_extent('z', z.minus, in.irz, in.irez, in.izmin, in.izmax, compare), in.rinf);
    const EdgePair xy(x, y, '0', '1');
    const EdgePair zx(z, x, '2', '3');
    const EdgePair yz(y, z, '4', '5');
    const Bit hit01 =
        as("hit01", Bit(~int_outside<D, F>('0', xy.first) & ~int_outside<D, F>('1', xy.second)));
    const Bit hit23 =
        as("hit23", Bit(~int_outside<D, F>('2', zx.first) & ~int_outside<D, F>('3', zx.second)));
    const Bit hit45 =
        as("hit45", Bit(~int_outside<D, F>('4', yz.first) & ~int_outside<D, F>('5', yz.second)));
    return as("inside", Bit((hit01 & hit23) & (hit45 & extent)));
  }
};

}  // namespace hitpipe::hls
