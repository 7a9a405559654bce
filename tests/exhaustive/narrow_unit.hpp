// The integer units in formats below the program's range: their datapath in C++, their graph, and the
// operands of a ray and a box. Boxes are rounded as in quantise_box(), which takes only the program's n.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

#include "hls/box/format.hpp"
#include "hls/box/major_format.hpp"
#include "hls/pipelines/int_major.hpp"
#include "hls/pipelines/int_plucker.hpp"
#include "hls/pipelines/int_slabs.hpp"
#include "rays/exact/grid.hpp"
#include "rays/world/coarse_axes.hpp"
#include "rays/world/int_box.hpp"
#include "rays/world/int_major_ray.hpp"
#include "rtl_gen/catalogue/design_of.hpp"
#include "sw_ref/quantise/int_plucker_ray.hpp"
#include "sw_ref/quantise/int_slabs_ray.hpp"
#include "tests/sw_ref/quantise/major_operands.hpp"

namespace hitpipe::ref::exhaustive {

/// Operands in port order; the last six are the box. No unit has more ports than that with a major axis.
using Operands = MajorOperandValues;

struct NarrowUnit {
  rtl::Design design;
  Format format;
  int coord;  ///< n
  int finer;  ///< bits by which origins are finer than boxes
  rtl::Evaluate evaluate;
  void (*set_up)(const Ray&, const Format&, std::int64_t* out);  ///< the ray's operands
  std::size_t ray_operands;

  /// For the names of tests: int_slabs_4_4.
  friend void PrintTo(const NarrowUnit& unit, std::ostream* out) {
    std::string name = to_string(unit.format);
    for (char& letter : name) {
      if (letter == '/' || letter == '+') letter = '_';
      if (letter == '-') letter = 'm';
    }
    *out << unit.design.name << '_' << name;
  }
};

inline void slabs_ray(const Ray& exact, const Format& format, std::int64_t* out) {
  const IntSlabsRay ray = IntSlabsRaySetup(exact, format.as<hls::IntBits>()).ray();
  for (const auto coordinate : ray.origin) *out++ = coordinate;
  *out++ = ray.length;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    *out++ = ray.irdvc_floor[axis];
    *out++ = ray.irdvc_ceil[axis];
  }
  *out = ray.infinite ? 1 : 0;
}

inline void plucker_ray(const Ray& exact, const Format& format, std::int64_t* out) {
  const IntPluckerRay ray = IntPluckerRaySetup(exact, format.as<hls::IntBits>()).ray();
  for (const auto& vector : {ray.origin, ray.end.at, ray.direction}) {
    for (const auto component : vector) *out++ = component;
  }
  *out = ray.end.infinite ? 1 : 0;
}

inline void major_ray(const Ray& exact, const Format& format, std::int64_t* out) {
  const IntMajorRaySetup set_up(exact, format.as<hls::MajorBits>());
  Operands operands{};
  put_ray(set_up, exact.length, operands);
  std::copy_n(operands.begin(), major_ray_operands, out);
}

inline IntBox narrow_box(const Aabb& box, int coord_bits, int finer = 0) {
  IntBox rounded;
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    rounded.min[i] = static_cast<std::int32_t>(fine_lower(box.min[axis], coord_bits, finer));
    rounded.max[i] = static_cast<std::int32_t>(-fine_lower(-box.max[axis], coord_bits, finer));
  }
  return rounded;
}

/// The operands of the ray begin with its origin in units that can have coarse axes.
inline void cut_origin(const CoarseAxes& coarse, int coord_bits, std::int64_t* operands) {
  if (!coarse.any()) return;
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

/// Formats down to the smallest for which the proofs of sw_ref/quantise hold.
template <class Bits>
const FormatFamily& proved_formats() {
  static const FormatFamily family = [] {
    FormatFamily wider = family_of<Bits>;
    wider.valid = [](const FormatNumbers& n) {
      return Format(family_of<Bits>, n).template as<Bits>().proved();
    };
    return wider;
  }();
  return family;
}

template <class Pipeline>
NarrowUnit narrow_unit(const typename Pipeline::Bits& bits,
                       void (*set_up)(const Ray&, const Format&, std::int64_t*), std::size_t ray_operands,
                       int finer = 0) {
  rtl::Design design = rtl::design_of<Pipeline>();
  const Format format(proved_formats<typename Pipeline::Bits>(), Format(bits).numbers());
  design.default_format = format;
  return {design, format, bits.coord, finer, design.evaluate(format), set_up, ray_operands};
}

/// Slabs and Pluecker at n and t = 4 .. 2n-1.
inline std::vector<NarrowUnit> units(int n) {
  std::vector<NarrowUnit> all;
  for (int t = hls::IntBits::min_proved; t < 2 * n; ++t) {
    all.push_back(narrow_unit<hls::IntSlabs>({n, t}, slabs_ray, 11));
    all.push_back(narrow_unit<hls::IntPlucker>({n, t}, plucker_ray, 10));
  }
  return all;
}

/// The same datapath; the formats of the sweeps have instances of their own, which are fast.
struct NarrowMajor : hls::IntMajor {
  using BuiltIn = hls::FormatList<hls::MajorFormat<4, 0, 3>, hls::MajorFormat<4, 0, 4, 1>,
                                  hls::MajorFormat<4, 1, 3>, hls::MajorFormat<4, 1, 4, -1>,
                                  hls::MajorFormat<4, 2, 3, 2>, hls::MajorFormat<5, 1, 3, -2>>;
};

/// A major axis: origins on the planes' grid and finer, mantissas of 3 and 4 bits, fractions of both signs.
inline std::vector<NarrowUnit> major_units() {
  std::vector<NarrowUnit> all;
  const auto add = [&]<class... F>(hls::FormatList<F...>) {
    (all.push_back(narrow_unit<NarrowMajor>(F::bits, major_ray, major_ray_operands, F::bits.finer)), ...);
  };
  add(NarrowMajor::BuiltIn());
  return all;
}

}  // namespace hitpipe::ref::exhaustive
