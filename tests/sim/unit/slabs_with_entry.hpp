// int_slabs with a second result, for tests: the distance at which the ray enters the slab of axis x.
#pragma once

#include "hls/pipelines/int_slabs.hpp"
#include "rtl_gen/catalogue/design_of.hpp"

namespace hitpipe::hls {

template <class D, class F>
struct SlabsWithEntryResults {
  typename D::bit hit;
  typename F::template Interval<D> entry;

  template <class Self, class Visit>
  static constexpr void for_each(const IntBits& format, Self& self, Visit&& visit) {
    visit(Result{"hit", Meaning::hit, 0, 1, false}, self.hit);
    visit(Result{"entry", Meaning::entry, 0, format.interval, true}, self.entry);
  }
};

struct SlabsWithEntry : IntSlabs {
  static constexpr const char* name = "slabs_with_entry";

  template <class D, class F>
  using Results = SlabsWithEntryResults<D, F>;

  template <class D, class F>
  static constexpr Results<D, F> test(const F& format, const IntSlabsOperands<D, F>& in) {
    using Interval = typename F::template Interval<D>;
    const auto x =
        int_slabs::slab_factors(format, 'x', in.irx, in.ixmin, in.ixmax, in.iri_floor, in.iri_ceil);
    return {IntSlabs::test<D>(format, in).hit, int_slabs::int_slab<Interval>(format, 'x', x).near};
  }
};

}  // namespace hitpipe::hls
