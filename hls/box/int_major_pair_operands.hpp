// The operands and results of the major-axis unit for two boxes (docs/never_misses.md): a ray, where it enters and
// leaves their parent, and the six planes and owners that tell the two boxes apart.
#pragma once

#include "hls/box/int_major_operands.hpp"

namespace hitpipe {
namespace hls {

/// Which box has a plane that differs from the parent's: 0 the first, 1 the second.
template <class D>
struct PlaneOwners {
  using bit = typename D::bit;

  bit own_xmin, own_xmax, own_ymin, own_ymax, own_zmin, own_zmax;

  template <class Self, class Visit>
  static constexpr void for_each(const MajorBits& /*format*/, Self& self, Visit&& visit) {
    visit(flag_operand("own_xmin", Role::owner), self.own_xmin);
    visit(flag_operand("own_xmax", Role::owner), self.own_xmax);
    visit(flag_operand("own_ymin", Role::owner), self.own_ymin);
    visit(flag_operand("own_ymax", Role::owner), self.own_ymax);
    visit(flag_operand("own_zmin", Role::owner), self.own_zmin);
    visit(flag_operand("own_zmax", Role::owner), self.own_zmax);
  }
};

/// A plane belongs to the box that owns it. The other box has the parent's plane there.
template <class D, class F>
struct IntMajorPairOperands : MajorRay<D, F>, MajorPlanes<D, F>, PlaneOwners<D> {
  using length = typename F::template Length<D>;

  length parent_near;  ///< where the ray enters the parent, at least 0
  length parent_far;   ///< where it leaves the parent or ends, whichever comes first; at least 0

  template <class Self, class Visit>
  static constexpr void for_each(const MajorBits& format, Self& self, Visit&& visit) {
    MajorRay<D, F>::for_each(format, self, visit);
    visit(format.inner_distance("parent_near", Role::entry), self.parent_near);
    visit(format.inner_distance("parent_far", Role::length), self.parent_far);
    MajorPlanes<D, F>::for_each(format, self, visit);
    PlaneOwners<D>::for_each(format, self, visit);
  }
};

/// The distances of a box have a meaning only if its HIT is 1.
template <class D, class F>
struct IntMajorPairResults {
  using bit = typename D::bit;
  using length = typename F::template Length<D>;

  bit hit_0, hit_1;
  length near_0, far_0;
  length near_1, far_1;
  bit second_first;  ///< 1: the ray enters the second box before the first

  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    const MajorBits bits = format;
    visit(Result{"hit_0", Meaning::hit, 0, 1, false}, self.hit_0);
    visit(Result{"hit_1", Meaning::hit, 1, 1, false}, self.hit_1);
    visit(Result{"near_0", Meaning::entry, 0, bits.length(), true}, self.near_0);
    visit(Result{"far_0", Meaning::exit, 0, bits.length(), true}, self.far_0);
    visit(Result{"near_1", Meaning::entry, 1, bits.length(), true}, self.near_1);
    visit(Result{"far_1", Meaning::exit, 1, bits.length(), true}, self.far_1);
    visit(Result{"second_first", Meaning::order, 0, 1, false}, self.second_first);
  }
};

}  // namespace hls
}  // namespace hitpipe
