// The two halves of the Pluecker test that float and integer units share (sections 3.3 and 6.3.2): where the
// ray begins and ends, and which box coordinates make up each of the six silhouette edges. All eight ray
// classes use one set of multiplexers. The class is the three sign bits of the direction, 1 for minus.
//   Value  a coordinate: an integer or an Fp of domain D;  Bit  D::bit
#pragma once

#include "hls/num/fp.hpp"

namespace hitpipe {
namespace hls {

/// Gives both orders of two integers; for floats there is fp_compare.
template <class Bit>
struct IntOrder {
  template <class Value>
  constexpr Order<Bit> operator()(const Value& a, const Value& b) const {
    return {Bit(a < b), Bit(a > b)};
  }
};

/// Parts A and B of figures 6.3 and 6.4 on one axis, figures 7.7 and 7.11.
template <class Bit>
struct AxisExtent {
  Bit behind;  ///< the box lies behind the ray's origin
  Bit beyond;  ///< the box lies beyond the ray's endpoint
};

/// `compare` gives the Order of two coordinates.
template <class Bit, class Value, class Compare>
constexpr AxisExtent<Bit> axis_extent(char axis, const Bit& minus, const Value& origin, const Value& endpoint,
                                      const Value& plane_min, const Value& plane_max,
                                      const Compare& compare) {
  const Value last_plane = as("last_plane", axis, select(minus, plane_min, plane_max));
  const Order<Bit> start = compare(origin, last_plane);
  const Value first_plane = as("first_plane", axis, select(minus, plane_max, plane_min));
  const Order<Bit> end = compare(endpoint, first_plane);
  return {as("behind", axis, select(minus, start.less, start.greater)),
          as("beyond", axis, select(minus, end.greater, end.less))};
}

/// On all three axes the box is neither behind the ray nor beyond it: hitExtent of figures 7.7 and 7.11.
template <class Bit>
constexpr Bit within_extent(const AxisExtent<Bit>& x, const AxisExtent<Bit>& y, const AxisExtent<Bit>& z,
                            const Bit& rinf) {
  const Bit ahead = as("ahead", ~x.behind & ~y.behind & ~z.behind);
  const Bit reached = as("reached", ~x.beyond & ~y.beyond & ~z.beyond);
  return as("extent", ahead & (reached | rinf));
}

/// One axis of the box as seen from the ray: its direction there, and the planes less the origin.
template <class Bit, class Value>
struct AxisView {
  Value direction;
  Bit minus;
  Value a, b;  ///< lower and upper plane: xa and xb of figure 6.3
};
template <class Bit, class Value>
constexpr AxisView<Bit, Value> axis_view(const Value& direction, const Bit& minus, const Value& a,
                                         const Value& b) {
  return {direction, minus, a, b};
}

/// Operands of a multiplier: a direction component and a plane.
template <class Value>
struct SideFactors {
  Value direction, plane;
};

/// An edge of the silhouette: the ray passes outside it when q - p is negative (figures 7.9, 7.13).
template <class Value>
struct SilhouetteEdge {
  SideFactors<Value> q, p;
};

/// A direction component of axis `own` and its plane: `if_minus` in classes with minus on that axis.
template <class Bit, class Value>
constexpr SideFactors<Value> side_factors(const char* name, char suffix, const AxisView<Bit, Value>& own,
                                          const Value& if_minus, const Value& if_plus) {
  return {own.direction, as(name, suffix, select(own.minus, if_minus, if_plus))};
}

template <class Value>
struct EdgePair {
  SilhouetteEdge<Value> first, second;
};

/// The two silhouette edges parallel to the third axis. Reflecting an axis turns its plus class into the
/// minus class, swaps its planes and changes the sign of both terms. So the plane of a term depends only on
/// the sign of its own component, and the comparison is the same in all classes.
template <class Bit, class Value>
constexpr EdgePair<Value> edge_pair(const AxisView<Bit, Value>& i, const AxisView<Bit, Value>& j,
                                    char number_first, char number_second) {
  return {{side_factors("q_plane", number_first, j, i.a, i.b),
           side_factors("p_plane", number_first, i, j.b, j.a)},
          {side_factors("q_plane", number_second, i, j.a, j.b),
           side_factors("p_plane", number_second, j, i.b, i.a)}};
}

}  // namespace hls
}  // namespace hitpipe
