// The integer units in formats below the program's range: their datapath in C++, their graph, and the
// operands of a ray and a box. Boxes are rounded as in quantise_box(), which takes only the program's n.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <ostream>
#include <vector>

#include "hls/pipelines/int_plucker.hpp"
#include "hls/pipelines/int_slabs.hpp"
#include "rtl_gen/catalogue/design_of.hpp"
#include "sw_ref/quantise/coarse_axes.hpp"
#include "sw_ref/quantise/grid.hpp"
#include "sw_ref/quantise/int_box.hpp"
#include "sw_ref/quantise/int_plucker_ray.hpp"
#include "sw_ref/quantise/int_slabs_ray.hpp"

namespace hitpipe::ref::exhaustive {

/// Operands in port order; the last six are the box. The Pluecker unit has one port fewer.
using Operands = std::array<std::int64_t, 17>;

struct NarrowUnit {
  rtl::Design design;
  hls::IntBits bits;
  rtl::Format format;
  rtl::Evaluate evaluate;
  void (*set_up)(const Ray&, hls::IntBits, std::int64_t* out);  ///< the ray's operands
  std::size_t ray_operands;

  /// For the names of tests: int_slabs_4_4.
  friend void PrintTo(const NarrowUnit& unit, std::ostream* out) {
    *out << unit.design.name << '_' << unit.bits.coord << '_' << unit.bits.interval;
  }
};

inline void slabs_ray(const Ray& exact, hls::IntBits bits, std::int64_t* out) {
  const IntSlabsRay ray = IntSlabsRaySetup(exact, bits).ray();
  for (const auto coordinate : ray.origin) *out++ = coordinate;
  *out++ = ray.length;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    *out++ = ray.irdvc_floor[axis];
    *out++ = ray.irdvc_ceil[axis];
  }
  *out = ray.infinite ? 1 : 0;
}

inline void plucker_ray(const Ray& exact, hls::IntBits bits, std::int64_t* out) {
  const IntPluckerRay ray = IntPluckerRaySetup(exact, bits).ray();
  for (const auto& vector : {ray.origin, ray.end.at, ray.direction}) {
    for (const auto component : vector) *out++ = component;
  }
  *out = ray.end.infinite ? 1 : 0;
}

inline IntBox narrow_box(const Aabb& box, int coord_bits) {
  IntBox rounded;
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    rounded.min[i] = static_cast<std::int32_t>(grid_floor(box.min[axis], coord_bits, Half::down));
    rounded.max[i] = static_cast<std::int32_t>(-grid_floor(-box.max[axis], coord_bits, Half::down));
  }
  return rounded;
}

/// The operands of the ray begin with its origin.
inline void cut_origin(const CoarseAxes& coarse, int coord_bits, std::int64_t* operands) {
  IntOrigin origin;
  for (std::size_t axis = 0; axis < 3; ++axis) origin[axis] = static_cast<std::int32_t>(operands[axis]);
  origin = coarse_origin(origin, coarse, coord_bits);
  std::copy(origin.begin(), origin.end(), operands);
}

inline void put_box(const IntBox& box, std::int64_t* out) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    *out++ = box.min[axis];
    *out++ = box.max[axis];
  }
}

/// Formats n/t down to the smallest for which the proofs of sw_ref/quantise hold.
inline const rtl::FormatFamily& proved_formats() {
  static const rtl::FormatFamily family = [] {
    rtl::FormatFamily wider = rtl::FamilyOf<hls::IntBits>::family;
    wider.valid = [](const rtl::FormatNumbers& n) { return hls::IntBits{n[0], n[1]}.proved(); };
    return wider;
  }();
  return family;
}

template <class Pipeline>
NarrowUnit narrow_unit(hls::IntBits bits, void (*set_up)(const Ray&, hls::IntBits, std::int64_t*),
                       std::size_t ray_operands) {
  rtl::Design design = rtl::design_of<Pipeline>();
  const rtl::Format format(proved_formats(), rtl::Format(bits).numbers());
  design.default_format = format;
  return {design, bits, format, design.evaluate(format), set_up, ray_operands};
}

/// Both units at n and t = 4 .. 2n-1.
inline std::vector<NarrowUnit> units(int n) {
  std::vector<NarrowUnit> all;
  for (int t = hls::IntBits::min_proved; t < 2 * n; ++t) {
    all.push_back(narrow_unit<hls::IntSlabs>({n, t}, slabs_ray, 11));
    all.push_back(narrow_unit<hls::IntPlucker>({n, t}, plucker_ray, 10));
  }
  return all;
}

}  // namespace hitpipe::ref::exhaustive
