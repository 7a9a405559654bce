// Faults of the set-up of rays and boxes (sections 6.2.1 and 6.3.1, docs/never_misses.md) and of the datapath of the
// integer units.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>

#include "rtl_gen/graph/graph.hpp"
#include "sim/software/box_software.hpp"

namespace hitpipe::sim {

using Operands = std::span<std::int64_t>;
/// Changes the operands of the correct set-up, in port order.
using SetupFault = void(const ref::Ray& ray, const ref::Aabb& box, const Format& format, Operands in);

using Args = std::span<const rtl::NodeId>;
/// What replaces `node` in the faulty graph `to`; rtl::no_node keeps the node. `args` are its operands there.
using GraphFault = rtl::NodeId(rtl::Graph& to, const rtl::Node& node, Args args);

/// The node as it is.
[[nodiscard]] rtl::NodeId copied(rtl::Graph& to, const rtl::Node& node, Args args);
/// A copy of the graph with the fault. Throws std::logic_error if the fault changes nothing.
[[nodiscard]] rtl::Graph mutated(const rtl::Graph& right, const std::function<GraphFault>& fault);
[[nodiscard]] std::unique_ptr<BoxTest> mutated_set_up(const rtl::Design& design, const Format& format,
                                                      SetupFault* fault);
/// Copies the traced graph with the fault and evaluates it. Throws std::logic_error if the fault changes
/// nothing.
[[nodiscard]] std::unique_ptr<BoxTest> mutated_datapath(const rtl::Design& design, const Format& format,
                                                        GraphFault* fault);

// Set-up of int_slabs and int_plucker.
SetupFault half_unit_left_out;
SetupFault box_rounded_to_nearest;
/// G * x +- 1/2 in binary32.
SetupFault box_in_binary32;
/// Towards zero, not to nearest.
SetupFault origin_truncated;

// Set-up of int_slabs.
/// scale / r in binary32. Its ceiling is sometimes one more than the width holds.
SetupFault irdvc_in_binary32;
/// The same, limited to the width.
SetupFault irdvc_in_binary32_clamped;
/// The ceiling of a quotient in (0, 1) is 0, and so is the floor of one in (-1, 0).
SetupFault irdvc_below_one_is_zero;
SetupFault irlen_not_saturated;
/// Loses k + 1 bits where the intervals lose k.
SetupFault irlen_trimmed_one_bit_more;
/// floor(length * scale) * G.
SetupFault irlen_floored_before_the_grid;

// Set-up of int_plucker.
/// An endpoint outside the cube is clamped to it, component by component, and rinf is not set.
SetupFault endpoint_clamped;
SetupFault pluecker_rinf_ignored;

// Set-ups that are no faults.
/// Slabs: irlen is then the largest length, and no near distance exceeds it.
SetupFault slabs_rinf_ignored;
/// Pluecker: the box is half a unit larger than it needs to be here. In class plus, with d >= 0 and the
/// common point's coordinate y: floor(G end) >= floor(G y) >= floor(G min) >= ixmin; class minus is the
/// mirror image. With d < 0 rounded to 0 the ray moves by less than half a unit in the cube: G end > G o -
/// 1/2 >= G min - 1/2 >= ixmin.
SetupFault endpoint_rounded_inward;
/// Pluecker: the errors f of two components then have the signs of the components, as x_i and x_j have. q - p
/// >= (id_j - e_j) x_i - (id_i - e_i) x_j is the difference of two terms f |x| of one sign, with f < 1 and
/// |x| <= M, so it is more than -M. If a component below 0 becomes 0, -1 < e and x = s e > -1, so the integer
/// b >= 0.
SetupFault direction_truncated;

// Set-up of int_major.
/// Rounded outward, but without half a unit of the origin's grid.
SetupFault major_box_not_grown;
/// By a quarter of a unit of the origin's grid.
SetupFault major_box_grown_by_half_as_much;
/// In the mirrored world, where directions are positive, a tie goes up.
SetupFault major_origin_ties_reversed;
/// One mantissa for both bounds.
SetupFault major_mantissa_to_nearest;
/// An upper mantissa of 2 becomes the largest one, and the exponent stays.
SetupFault major_upper_mantissa_of_two_cut;
/// Exponents end at n+g-2, with the largest mantissas.
SetupFault major_exponent_cap_one_less;
/// The low bits of a length that is too large.
SetupFault major_length_wraps;

// Datapath of int_slabs.
/// The near distance of x is a product with the IRDVC's ceiling, whatever sign the difference has.
GraphFault near_floor_dropped;
GraphFault near_operands_swapped;
/// The far distance of y is a distance to the near plane.
GraphFault far_from_the_near_plane;

// Datapath of int_plucker.
GraphFault edge_bound_off_by_one;
/// p - q has t bits.
GraphFault side_bit_dropped;
/// A plane of edge 0 is the other plane of its axis.
GraphFault edge_planes_swapped;
/// The ray's end is compared with the far plane of z.
GraphFault last_plane_for_the_first;

// No fault: a node is made again.
GraphFault made_again;

// Datapath of int_major.
/// What the shift moves out is lost.
GraphFault major_shift_wraps;
GraphFault major_near_rounded_up;
/// Near distances of slot a are products with the upper mantissa, whatever sign the difference has.
GraphFault major_near_with_the_upper_bound;
/// Far distances of slot b are products with the lower mantissa.
GraphFault major_far_with_the_lower_bound;
/// -x - 1 stands for x in the plane, but not in the bits of the finer grid below it.
GraphFault major_mirrored_plane_filled_with_zeros;
/// In the integer world the far differences lack their carry.
GraphFault major_far_carry_missing;

}  // namespace hitpipe::sim
