// The operands of hls::FpSlabsOperands (section 2.3.1).
#include <algorithm>
#include <cmath>

#include "hls/box/fp_slabs_operands.hpp"
#include "rays/trace/slabs.hpp"
#include "sim/designs/float_patterns.hpp"
#include "sim/designs/fp_design.hpp"
#include "sim/designs/set_up_feed.hpp"
#include "sw_ref/quantise/float_ray.hpp"
#include "sw_ref/trace/store_tracer.hpp"

namespace hitpipe::sim {

namespace {

class FpSlabsSetup {
 public:
  using Box = PatternBox;
  using Bits = hls::Binary32;
  using Operands = hls::FpSlabsOperands<Words, Bits>;

  FpSlabsSetup(const ref::Ray& ray, const Format& /*binary32*/)
      : origin_(patterns(ray.origin)), irdvc_(patterns(ref::float_irdvc(ray.direction))) {}

  static void boxes(std::span<const ref::Aabb> boxes, const Format& /*binary32*/, std::span<Box> out) {
    std::transform(boxes.begin(), boxes.end(), out.begin(), [](const ref::Aabb& box) { return Box(box); });
  }
  void fill(float length, Operands& in) const {
    put(origin_, in.rx, in.ry, in.rz);
    put(pattern(std::abs(length)), in.rlen);  // -0 is a length too
    put(irdvc_, in.ri_inv, in.rj_inv, in.rk_inv);
    in.rinf = std::isinf(length) ? 1 : 0;
  }

 private:
  Patterns origin_;
  Patterns irdvc_;
};

std::unique_ptr<ref::Tracer> fp_slabs_tracer(const TracedUnit& unit, const ref::Mesh& mesh,
                                             const ref::Bvh& bvh) {
  return ref::store_tracer(ref::PlainNodes(bvh), ref::TestMaker<ref::Slabs<float>>(), ref::Leaves(mesh, bvh),
                           {.ends = unit.ends});
}

ref::TracerOptions fp_slabs_named(const Format& /*binary32*/) {
  return {.algorithm = ref::Algorithm::slabs_dsa, .arithmetic = ref::Arithmetic::binary32};
}

/// Mantissas, with a bit to round.
area::Divisions fp_slabs_divisions(const Format& /*binary32*/) {
  return {.count = 3, .quotient_bits = 25};
}

}  // namespace

Software fp_slabs_software() {
  Software software = fp_design_software();
  software.feed = set_up_feed<FpSlabsSetup>;
  software.box_test = set_up_test<FpSlabsSetup>;
  software.tracer = fp_slabs_tracer;
  software.named_tracer = fp_slabs_named;
  software.divisions = fp_slabs_divisions;
  software.comparison_test = ize_slabs_test;
  return software;
}

}  // namespace hitpipe::sim
