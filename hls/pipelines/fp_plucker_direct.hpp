// The float Pluecker test with its products compared directly: the ray passes outside an edge when q < p.
// The thesis subtracts first, q - p < 0 (figures 7.9, 7.10). Both agree for every pair of floats:
//   finite    q - p is a whole multiple of the smallest subnormal number. Where q and p differ, rounding to
//             nearest keeps the sign and never gives 0. Where they are equal, the difference is +0.
//   overflow  a difference beyond the largest number rounds to the infinity of its sign.
//   infinite  equal infinities give NaN, which is not below 0; and neither of them is below the other.
//   NaN       if q or p is NaN, both comparisons are false.
// z3 proves it for all pairs of binary32 (tests/formal/side_relation.sh). The six subtractors and their
// seven stages go: this unit has 13 stages, not 20.
#pragma once

#include "hls/pipelines/fp_plucker.hpp"

namespace hitpipe {
namespace hls {
namespace fp_plucker_direct {
struct FpLesserTerm {
  template <class Real>
  constexpr typename Real::Bit operator()(char number, const SilhouetteEdge<Real>& edge) const {
    return as("outside", number,
              fp_less(fp_plucker::fp_side_term("q", number, edge.q),
                      fp_plucker::fp_side_term("p", number, edge.p)));
  }
};

/// Fields and functions that this struct does not define are FpPlucker's.
struct FpPluckerDirect : FpPlucker {
  static constexpr const char* name = "fp_plucker_direct";
  static constexpr const char* summary = "float Pluecker, no side relations";
  static constexpr const char* header = __FILE__;
  using Shares = FpPlucker;

  template <class D, class F>
  static constexpr Results<D, F> test(const F& /*format*/, const Operands<D, F>& in) {
    return {fp_plucker::fp_plucker_hit(in, FpLesserTerm())};
  }
};

}  // namespace fp_plucker_direct

using fp_plucker_direct::FpPluckerDirect;

}  // namespace hls
}  // namespace hitpipe
