// The tests' own exact arithmetic: rational numbers, and the definition of meeting a box in them.
#pragma once

#include <algorithm>

#include <boost/multiprecision/cpp_int.hpp>

#include "rays/mesh/aabb.hpp"
#include "rays/mesh/ray.hpp"

namespace hitpipe::ref::oracle {

using Integer = boost::multiprecision::cpp_int;
using Rational = boost::multiprecision::cpp_rational;

inline Rational exact(double x) {
  return Rational(x);
}

inline Integer floor(const Rational& x) {
  const Integer n = numerator(x);
  const Integer d = denominator(x);
  Integer quotient = n / d;  // towards 0
  if (n < 0 && quotient * d != n) --quotient;
  return quotient;
}
inline Integer ceil(const Rational& x) {
  return -floor(Rational(-x));
}

inline bool meets(const Ray& ray, const Aabb& box) {
  Rational from = 0;
  Rational to = ray.is_infinite() ? Rational(0) : exact(ray.length);
  bool bounded = !ray.is_infinite();
  for (int axis = 0; axis < 3; ++axis) {
    const Rational origin = exact(ray.origin[axis]);
    const Rational direction = exact(ray.direction[axis]);
    const Rational low = exact(box.min[axis]);
    const Rational high = exact(box.max[axis]);
    if (direction == 0) {
      if (origin < low || origin > high) return false;
      continue;
    }
    const Rational at_low = (low - origin) / direction;
    const Rational at_high = (high - origin) / direction;
    from = std::max({from, std::min(at_low, at_high)});
    const Rational leave = std::max(at_low, at_high);
    if (!bounded || leave < to) to = leave;
    bounded = true;
  }
  return from <= to;
}

}  // namespace hitpipe::ref::oracle
