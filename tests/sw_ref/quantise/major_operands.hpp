// The operands of a unit with a major axis, in port order, and its datapath in any format.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "hls/num/domain.hpp"
#include "hls/num/sized.hpp"
#include "hls/pipelines/int_major.hpp"
#include "rays/world/int_box.hpp"
#include "rays/world/int_major_ray.hpp"

namespace hitpipe::ref {

/// 15 of the ray, 6 of the box.
inline constexpr std::size_t major_ray_operands = 15;
using MajorOperandValues = std::array<std::int64_t, major_ray_operands + 6>;

/// The operands of the ray. The box's operands are not changed.
inline void put_ray(const IntMajorRaySetup& set_up, float length, MajorOperandValues& values) {
  const IntMajorRay& ray = set_up.ray();
  std::int64_t* out = values.data();
  *out++ = ray.axes[0] == 1 ? 1 : 0;
  *out++ = ray.axes[0] == 2 ? 1 : 0;
  for (const bool backward : ray.backward) *out++ = backward ? 1 : 0;
  for (const std::int64_t origin : ray.origin) *out++ = origin;
  for (const MajorQuotient& quotient : ray.quotient) {
    *out++ = quotient.mantissa_low;
    *out++ = quotient.mantissa_high;
  }
  for (const MajorQuotient& quotient : ray.quotient) *out++ = quotient.exponent;
  *out = set_up.length(length);
}

inline void put_planes(const IntBox& box, MajorOperandValues& values) {
  std::int64_t* out = values.data() + major_ray_operands;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    *out++ = box.min[axis];
    *out++ = box.max[axis];
  }
}

namespace detail {

/// Reads operands in port order, and counts those outside the range that their port states.
struct MajorReader {
  template <int W, bool S>
  void operator()(const hls::Operand& port, hls::ap_base<W, S>& field) {
    field = next(port);
  }
  template <bool S>
  void operator()(const hls::Operand& port, hls::SizedInt<S, std::uint64_t>& field) {
    field = hls::SizedInt<S, std::uint64_t>(static_cast<std::uint64_t>(next(port)), port.width);
  }
  std::int64_t next(const hls::Operand& port) {
    out_of_range += *value < port.low || *value > port.high ? 1 : 0;
    return *value++;
  }

  const std::int64_t* value;
  int out_of_range = 0;
};

}  // namespace detail

struct MajorAnswer {
  bool hit;
  int out_of_range;  ///< operands outside the range of their port
};

/// In the format F, MajorBits or a MajorFormat, in domain D.
template <class D, class F>
MajorAnswer major_answer(const F& format, const MajorOperandValues& values) {
  hls::IntMajorOperands<D, F> in;
  detail::MajorReader reader{values.data()};
  in.for_each(format, in, reader);
  return {hls::IntMajor::test<D>(format, in).hit.to_int64() != 0, reader.out_of_range};
}

}  // namespace hitpipe::ref
