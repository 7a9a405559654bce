// A design that answers for two boxes at a time, for tests: the slabs of two boxes on one axis give two HITs
// and the distance at which the ray enters the first. HIT of the first box is not the first result.
#pragma once

#include "hls/box/format.hpp"
#include "hls/box/int_format.hpp"
#include "hls/num/bits.hpp"
#include "rtl_gen/catalogue/design_of.hpp"

namespace hitpipe::hls {

template <class D, class F>
struct TwoBoxesOperands {
  using Coord = typename F::template Coord<D>;

  Coord irx, iri, min_a, max_a, min_b, max_b;
  typename F::template Interval<D> irlen;

  template <class Self, class Visit>
  static constexpr void for_each(const IntBits& format, Self& self, Visit&& visit) {
    visit(format.point("irx", Role::origin, Axis::x), self.irx);
    visit(format.component("iri", Role::inverse, Axis::x), self.iri);
    visit(format.length("irlen"), self.irlen);
    visit(format.plane("min_a", Role::plane_low, Axis::x), self.min_a);
    visit(format.plane("max_a", Role::plane_high, Axis::x), self.max_a);
    visit(of_second(format.plane("min_b", Role::plane_low, Axis::x)), self.min_b);
    visit(of_second(format.plane("max_b", Role::plane_high, Axis::x)), self.max_b);
  }

 private:
  static constexpr Operand of_second(Operand plane) {
    plane.box = 1;
    return plane;
  }
};

template <class D, class F>
struct TwoBoxesResults {
  typename F::template Interval<D> entry;
  typename D::bit hit_a, hit_b;

  template <class Self, class Visit>
  static constexpr void for_each(const IntBits& format, Self& self, Visit&& visit) {
    visit(Result{"entry", Meaning::entry, 0, format.interval, true}, self.entry);
    visit(Result{"hit_a", Meaning::hit, 0, 1, false}, self.hit_a);
    visit(Result{"hit_b", Meaning::hit, 1, 1, false}, self.hit_b);
  }
};

struct TwoBoxes {
  static constexpr const char* name = "two_boxes";
  static constexpr const char* summary = "two boxes on one axis, for a test";
  static constexpr bool conservative = false;
  static constexpr DesignKind kind{"two_hits", 2, meanings(Meaning::hit), meanings()};
  static constexpr const char* header = __FILE__;

  using Bits = IntBits;
  using BuiltIn = FormatList<IntFormat<6, 6>>;
  template <class D, class F>
  using Operands = TwoBoxesOperands<D, F>;
  template <class D, class F>
  using Results = TwoBoxesResults<D, F>;

  template <class D, class F>
  static constexpr Results<D, F> test(const F& format, const Operands<D, F>& in) {
    using Bit = typename D::bit;
    using Interval = typename F::template Interval<D>;
    const auto distance = [&](const auto& plane) -> Interval {
      const auto product = resize(plane - in.irx, format.coord) * in.iri;
      return as_signed(slice(product, format.product() - 1_w, format.trimmed()));
    };
    const auto meets = [&](const Interval& near, const Interval& far) -> Bit {
      return ~Bit(in.irlen < near) & ~sign(far);
    };
    const Interval entry = distance(in.min_a);
    return {entry, meets(entry, distance(in.max_a)), meets(distance(in.min_b), distance(in.max_b))};
  }
};

}  // namespace hitpipe::hls

namespace hitpipe::rtl {

inline Design two_boxes() {
  Design design = design_of<hls::TwoBoxes>();
  design.default_format = hls::IntBits{6, 6};
  return design;
}

}  // namespace hitpipe::rtl
