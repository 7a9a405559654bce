// Faults of the ray and box set-up of the integer units (sections 6.2.1 and 6.3.1). Each changes the operands
// of the correct set-up, in port order.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "sim/check/box_test.hpp"

namespace hitpipe::sim {

using Operands = std::span<std::int64_t>;
using SetupFault = void (*)(const ref::Ray& ray, const ref::Aabb& box, const rtl::Format& format,
                            Operands in);

/// The design with a fault in its set-up.
[[nodiscard]] std::unique_ptr<BoxTest> mutated_set_up(const rtl::Design& design, const rtl::Format& format,
                                                      SetupFault fault);

// Both designs.
void half_unit_left_out(const ref::Ray& ray, const ref::Aabb& box, const rtl::Format& format, Operands in);
void box_rounded_to_nearest(const ref::Ray& ray, const ref::Aabb& box, const rtl::Format& format,
                            Operands in);
/// G * x +- 1/2 in binary32.
void box_in_binary32(const ref::Ray& ray, const ref::Aabb& box, const rtl::Format& format, Operands in);
/// Towards zero, not to nearest.
void origin_truncated(const ref::Ray& ray, const ref::Aabb& box, const rtl::Format& format, Operands in);

// Slabs.
/// scale / r in binary32. Its ceiling is sometimes one more than the width holds.
void irdvc_in_binary32(const ref::Ray& ray, const ref::Aabb& box, const rtl::Format& format, Operands in);
/// The same, limited to the width.
void irdvc_in_binary32_clamped(const ref::Ray& ray, const ref::Aabb& box, const rtl::Format& format,
                               Operands in);
/// The ceiling of a quotient in (0, 1) is 0, and so is the floor of one in (-1, 0).
void irdvc_below_one_is_zero(const ref::Ray& ray, const ref::Aabb& box, const rtl::Format& format,
                             Operands in);
void irlen_not_saturated(const ref::Ray& ray, const ref::Aabb& box, const rtl::Format& format, Operands in);
/// Loses k + 1 bits where the intervals lose k.
void irlen_trimmed_one_bit_more(const ref::Ray& ray, const ref::Aabb& box, const rtl::Format& format,
                                Operands in);
/// floor(length * scale) * G.
void irlen_floored_before_the_grid(const ref::Ray& ray, const ref::Aabb& box, const rtl::Format& format,
                                   Operands in);

// Pluecker.
/// An endpoint outside the cube is clamped to it, component by component, and rinf is not set.
void endpoint_clamped(const ref::Ray& ray, const ref::Aabb& box, const rtl::Format& format, Operands in);
void pluecker_rinf_ignored(const ref::Ray& ray, const ref::Aabb& box, const rtl::Format& format, Operands in);

// Changes that are not faults.
/// Slabs: irlen is then the largest length, and no near distance exceeds it.
void slabs_rinf_ignored(const ref::Ray& ray, const ref::Aabb& box, const rtl::Format& format, Operands in);
/// Pluecker: the box is half a unit larger than it needs to be here. In class plus, with d >= 0 and the
/// common point's coordinate y: floor(G end) >= floor(G y) >= floor(G min) >= ixmin; class minus is the
/// mirror image. With d < 0 rounded to 0 the ray moves by less than half a unit in the cube: G end > G o -
/// 1/2 >= G min - 1/2 >= ixmin.
void endpoint_rounded_inward(const ref::Ray& ray, const ref::Aabb& box, const rtl::Format& format,
                             Operands in);
/// Pluecker: the errors f of two components then have the signs of the components, as x_i and x_j have. q - p
/// >= (id_j - e_j) x_i - (id_i - e_i) x_j is the difference of two terms f |x| of one sign, with f < 1 and
/// |x| <= M, so it is more than -M. If a component below 0 becomes 0, -1 < e and x = s e > -1, so the integer
/// b >= 0.
void direction_truncated(const ref::Ray& ray, const ref::Aabb& box, const rtl::Format& format, Operands in);

}  // namespace hitpipe::sim
