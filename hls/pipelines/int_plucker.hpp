// The integer Pluecker test of section 6.3.2, figures 7.11 to 7.14, in n-bit coordinates. The ray meets the
// box if it passes inside the box's silhouette and the box lies between its ends. The test is conservative:
// it may say HIT too often but never misses. The direction is known to half a unit and products lose low
// bits, so a side relation counts as outside only below EBND.
// Widths: differences n bits, products 2n with t bits kept, side relations t+1 (the thesis prices t).
#pragma once

#include <cstdint>

#include "hls/box/box_hit.hpp"
#include "hls/box/format.hpp"
#include "hls/box/int_plucker_operands.hpp"
#include "hls/pipelines/plucker_parts.hpp"

namespace hitpipe {
namespace hls {
namespace int_plucker {
/// EBND, the smallest side relation of a ray that passes inside an edge: -ceil((2^(n-1)-2) / 2^k) with
/// k = 2n-1-t dropped bits; proved in sw_ref/quantise/int_plucker_ray.cpp. -1 at 24/24, -16 at 20/24.
constexpr std::int64_t edge_bound(const IntBits& format) {
  const std::int64_t largest = (std::int64_t{1} << (format.coord - 1)) - 2;
  const std::int64_t unit = std::int64_t{1} << format.trimmed();
  return -((largest + unit - 1) >> format.trimmed());
}

/// Planes less the origin: stage 1, figure 7.12.
template <class F, class Coord>
constexpr auto int_axis_view(const F& format, char axis, const Coord& direction, const Coord& origin,
                             const Coord& plane_min, const Coord& plane_max) {
  const Coord a = as("a", axis, resize(plane_min - origin, format.coord));
  const Coord b = as("b", axis, resize(plane_max - origin, format.coord));
  return axis_view(direction, sign(direction), a, b);
}

/// A term of a side relation: the upper t bits of a product, without bit 2n-1, which repeats the sign.
template <class F, class Coord>
constexpr auto side_term(const F& format, const char* name, char number, const SideFactors<Coord>& factors) {
  const auto whole = factors.direction * factors.plane;
  return as(name, number, as_signed(slice(whole, format.product() - 1_w, format.trimmed())));
}

/// The side relation of ray and edge is below EBND: figures 7.13 and 7.14.
template <class D, class F, class Coord>
constexpr typename D::bit int_outside(const F& format, char number, const SilhouetteEdge<Coord>& edge) {
  using Bit = typename D::bit;
  const auto q = side_term(format, "q", number, edge.q);
  const auto p = side_term(format, "p", number, edge.p);
  const auto side = as("side", number, q - p);
  const auto ebnd = as("EBND", as_signed(D::lit(edge_bound(format), width_of(side))));
  return as("outside", number, Bit(side < ebnd));
}

struct IntPlucker {
  static constexpr const char* name = "int_plucker";
  static constexpr const char* summary = "integer Pluecker test, figures 7.11-14";
  static constexpr bool conservative = true;
  static constexpr DesignKind kind = box_kind;
  static constexpr const char* header = __FILE__;
  using Bits = IntBits;
  using BuiltIn = FormatList<IntFormat<24, 24>, IntFormat<20, 24>, IntFormat<16, 16>, IntFormat<12, 12>>;
  template <class D, class F>
  using Operands = IntPluckerOperands<D, F>;
  template <class D, class F>
  using Results = BoxHit<typename D::bit>;
  template <class D, class F>
  static constexpr Results<D, F> test(const F& format, const IntPluckerOperands<D, F>& in) {
    using Bit = typename D::bit;
    const IntOrder<Bit> compare;
    const auto x = int_axis_view(format, 'x', in.iri, in.irx, in.ixmin, in.ixmax);
    const auto y = int_axis_view(format, 'y', in.irj, in.iry, in.iymin, in.iymax);
    const auto z = int_axis_view(format, 'z', in.irk, in.irz, in.izmin, in.izmax);
    const Bit extent =
        within_extent(axis_extent('x', x.minus, in.irx, in.irex, in.ixmin, in.ixmax, compare),
                      axis_extent('y', y.minus, in.iry, in.irey, in.iymin, in.iymax, compare),
                      axis_extent('z', z.minus, in.irz, in.irez, in.izmin, in.izmax, compare), in.rinf);
    const auto xy = edge_pair(x, y, '0', '1');
    const auto zx = edge_pair(z, x, '2', '3');
    const auto yz = edge_pair(y, z, '4', '5');
    const Bit hit01 =
        as("hit01", ~int_outside<D>(format, '0', xy.first) & ~int_outside<D>(format, '1', xy.second));
    const Bit hit23 =
        as("hit23", ~int_outside<D>(format, '2', zx.first) & ~int_outside<D>(format, '3', zx.second));
    const Bit hit45 =
        as("hit45", ~int_outside<D>(format, '4', yz.first) & ~int_outside<D>(format, '5', yz.second));
    return {as("inside", (hit01 & hit23) & (hit45 & extent))};
  }
};

}  // namespace int_plucker

using int_plucker::IntPlucker;

}  // namespace hls
}  // namespace hitpipe
