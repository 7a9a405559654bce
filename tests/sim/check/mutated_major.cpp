#include <algorithm>
#include <array>
#include <cmath>

#include "hls/box/major_format.hpp"
#include "rays/exact/grid.hpp"
#include "tests/sim/check/mutations.hpp"

namespace hitpipe::sim {
namespace {

using ref::Aabb;
using ref::Ray;
using rtl::Graph;
using rtl::no_node;
using rtl::Node;
using rtl::NodeId;
using rtl::Op;

// Ports of hls::IntMajorOperands, by slot m, a, b or a, b.
constexpr std::size_t major_y = 0;
constexpr std::size_t major_z = 1;
constexpr std::size_t back = 2;
constexpr std::size_t origin = 5;
constexpr std::size_t bounds = 8;
constexpr std::size_t exponents = 12;
constexpr std::size_t length = 14;

std::int64_t to_whole(double x) {
  return static_cast<std::int64_t>(x);
}

/// The axis in each slot.
std::array<int, 3> axes_of(Operands in) {
  const int major = in[major_y] != 0 ? 1 : in[major_z] != 0 ? 2 : 0;
  std::array<int, 3> axes{0, 1, 2};
  std::swap(axes[0], axes[static_cast<std::size_t>(major)]);
  return axes;
}

/// G 2^g x; exact up to n = 24.
double on_fine_grid(float x, hls::MajorBits bits) {
  return std::ldexp(static_cast<double>(ref::grid_scale(bits.coord)) * x, bits.finer);
}

/// Planes moved outward by `margin` units and rounded outward.
void grow_box(const Aabb& box, hls::MajorBits bits, double margin, Operands in) {
  const Operands faces = in.last(6);
  const auto unit = static_cast<double>(ref::grid_scale(bits.coord));
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    faces[2 * i] = to_whole(std::floor(unit * box.min[axis] - margin));
    faces[2 * i + 1] = to_whole(std::ceil(unit * box.max[axis] + margin));
  }
}

/// The quotient of slot a or b without its exponent, times 2^(p-1); 0 if the quotient is too large.
double scaled_quotient(const Ray& ray, hls::MajorBits bits, Operands in, std::size_t slot) {
  const auto axes = axes_of(in);
  const double component = std::abs(ray.direction[axes[slot + 1]]);
  const double most = std::abs(ray.direction[axes[0]]);
  const double quotient = component == 0 ? 0.0 : most / component;
  const double scaled = std::ldexp(quotient, bits.mantissa - 1 - static_cast<int>(in[exponents + slot]));
  return scaled < static_cast<double>(bits.largest_mantissa()) ? scaled : 0.0;
}

}  // namespace

void major_box_not_grown(const Ray& /*ray*/, const Aabb& box, const Format& format, Operands in) {
  grow_box(box, format.as<hls::MajorBits>(), 0.0, in);
}

void major_box_grown_by_half_as_much(const Ray& /*ray*/, const Aabb& box, const Format& format, Operands in) {
  const auto bits = format.as<hls::MajorBits>();
  grow_box(box, bits, std::ldexp(0.25, -bits.finer), in);
}

void major_origin_ties_reversed(const Ray& ray, const Aabb& /*box*/, const Format& format, Operands in) {
  const auto bits = format.as<hls::MajorBits>();
  const auto axes = axes_of(in);
  for (std::size_t slot = 0; slot < 3; ++slot) {
    const double fine = on_fine_grid(ray.origin[axes[slot]], bits);
    in[origin + slot] = in[back + slot] != 0 ? -to_whole(std::ceil(fine - 0.5)) - 1  //
                                             : to_whole(std::floor(fine + 0.5));
  }
}

void major_mantissa_to_nearest(const Ray& ray, const Aabb& /*box*/, const Format& format, Operands in) {
  for (std::size_t slot = 0; slot < 2; ++slot) {
    const Operands both = in.subspan(bounds + 2 * slot, 2);
    const double scaled = scaled_quotient(ray, format.as<hls::MajorBits>(), in, slot);
    if (scaled != 0) both[0] = both[1] = std::clamp(to_whole(std::round(scaled)), both[0], both[1]);
  }
}

void major_upper_mantissa_of_two_cut(const Ray& /*ray*/, const Aabb& /*box*/, const Format& format,
                                     Operands in) {
  const auto bits = format.as<hls::MajorBits>();
  for (std::size_t slot = 0; slot < 2; ++slot) {
    const Operands both = in.subspan(bounds + 2 * slot, 2);
    if (both[0] == both[1] || both[1] != std::int64_t{1} << (bits.mantissa - 1)) continue;
    both[0] = both[1] = bits.largest_mantissa();
    --in[exponents + slot];
  }
}

void major_exponent_cap_one_less(const Ray& /*ray*/, const Aabb& /*box*/, const Format& format, Operands in) {
  const auto bits = format.as<hls::MajorBits>();
  for (std::size_t slot = 0; slot < 2; ++slot) {
    if (in[exponents + slot] < bits.largest_exponent()) continue;
    in[exponents + slot] = bits.largest_exponent() - 1;
    in[bounds + 2 * slot] = in[bounds + 2 * slot + 1] = bits.largest_mantissa();
  }
}

void major_length_wraps(const Ray& ray, const Aabb& /*box*/, const Format& format, Operands in) {
  const auto bits = format.as<hls::MajorBits>();
  const double full = std::ldexp(static_cast<double>(ray.length) * std::abs(ray.direction[axes_of(in)[0]]) *
                                     static_cast<double>(ref::grid_scale(bits.coord)),
                                 bits.fraction);
  if (in[length] < bits.largest_length() || !std::isfinite(full)) return;
  in[length] = to_whole(std::fmod(std::floor(full), static_cast<double>(bits.largest_length() + 1)));
}

/// Of its ors only the last one of the shifter has more than one bit.
NodeId major_shift_wraps(Graph& /*to*/, const Node& node, Args args) {
  return node.op == Op::bit_or && node.width > 1 ? args[0] : no_node;
}

NodeId major_near_rounded_up(Graph& to, const Node& node, Args args) {
  if (node.op != Op::slice || (node.name != "t_near_a" && node.name != "t_near_b")) return no_node;
  const int width = to[args[0]].width;
  const NodeId below = to.constant(width, (std::uint64_t{1} << node.low) - 1);
  return to.slice(to.binary(Op::add, args[0], below), node.low + node.width - 1, node.low);
}

NodeId major_near_with_the_upper_bound(Graph& /*to*/, const Node& node, Args args) {
  return node.op == Op::mux && node.name == "q_near_a" ? args[1] : no_node;
}

NodeId major_far_with_the_lower_bound(Graph& /*to*/, const Node& node, Args args) {
  return node.op == Op::mux && node.name == "q_far_b" ? args[1] : no_node;
}

/// A plane is n bits above g others. The shift concatenates too, but n + g - 1 bits in all.
NodeId major_mirrored_plane_filled_with_zeros(Graph& to, const Node& node, Args args) {
  if (node.op != Op::concat) return no_node;
  const Node below = to[args[1]];
  const bool spread_bit =
      (below.op == Op::extend && to[below.args[0]].op == Op::input) || below.op == Op::input;
  const bool plane = to[args[0]].op == Op::bit_xor;
  return spread_bit && plane ? to.concat(args[0], to.constant(below.width, 0)) : no_node;
}

/// The terms of a far sum have a 1 below them, which makes the carry.
NodeId major_far_carry_missing(Graph& to, const Node& node, Args args) {
  if (node.op != Op::concat) return no_node;
  const Node below = to[args[1]];
  const bool carries = below.op == Op::constant && below.width == 1 && below.value == 1;
  return carries ? to.concat(args[0], to.constant(1, 0)) : no_node;
}

}  // namespace hitpipe::sim
