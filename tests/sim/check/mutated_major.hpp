// Faults of the unit with a major axis (docs/major.md): of its set-up, and of its datapath.
#pragma once

#include "tests/sim/check/mutated_datapath.hpp"
#include "tests/sim/check/mutated_set_up.hpp"

namespace hitpipe::sim {

// Set-up.
/// Rounded outward, but without half a unit of the origin's grid.
void major_box_not_grown(const ref::Ray& ray, const ref::Aabb& box, const rtl::Format& format, Operands in);
/// By a quarter of a unit of the origin's grid.
void major_box_grown_by_half_as_much(const ref::Ray& ray, const ref::Aabb& box, const rtl::Format& format,
                                     Operands in);
/// In the mirrored world, where directions are positive, a tie goes up.
void major_origin_ties_reversed(const ref::Ray& ray, const ref::Aabb& box, const rtl::Format& format,
                                Operands in);
/// One mantissa for both bounds.
void major_mantissa_to_nearest(const ref::Ray& ray, const ref::Aabb& box, const rtl::Format& format,
                               Operands in);
/// An upper mantissa of 2 becomes the largest one, and the exponent stays.
void major_upper_mantissa_of_two_cut(const ref::Ray& ray, const ref::Aabb& box, const rtl::Format& format,
                                     Operands in);
/// Exponents end at n+g-2, with the largest mantissas.
void major_exponent_cap_one_less(const ref::Ray& ray, const ref::Aabb& box, const rtl::Format& format,
                                 Operands in);
/// The low bits of a length that is too large.
void major_length_wraps(const ref::Ray& ray, const ref::Aabb& box, const rtl::Format& format, Operands in);

// Datapath.
/// What the shift moves out is lost.
rtl::NodeId major_shift_wraps(rtl::Graph& to, const rtl::Node& node, std::span<const rtl::NodeId> args);
rtl::NodeId major_near_rounded_up(rtl::Graph& to, const rtl::Node& node, std::span<const rtl::NodeId> args);
/// Near distances of slot a are products with the upper mantissa, whatever sign the difference has.
rtl::NodeId major_near_with_the_upper_bound(rtl::Graph& to, const rtl::Node& node,
                                            std::span<const rtl::NodeId> args);
/// Far distances of slot b are products with the lower mantissa.
rtl::NodeId major_far_with_the_lower_bound(rtl::Graph& to, const rtl::Node& node,
                                           std::span<const rtl::NodeId> args);
/// The plane is mirrored to -x - 1, but its bits on the finer grid are not.
rtl::NodeId major_mirrored_plane_filled_with_zeros(rtl::Graph& to, const rtl::Node& node,
                                                   std::span<const rtl::NodeId> args);

}  // namespace hitpipe::sim
