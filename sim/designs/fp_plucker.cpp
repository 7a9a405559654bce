// The operands of hls::FpPluckerOperands (section 3.3).
#include <algorithm>

#include "hls/box/fp_plucker_operands.hpp"
#include "sim/designs/float_patterns.hpp"
#include "sim/designs/fp_design.hpp"
#include "sim/designs/set_up_feed.hpp"
#include "sw_ref/quantise/float_ray.hpp"
#include "sw_ref/trace/plucker.hpp"
#include "sw_ref/trace/store_tracer.hpp"

namespace hitpipe::sim {

namespace {

class FpPluckerSetup {
 public:
  using Box = PatternBox;
  using Bits = hls::Binary32;
  using Operands = hls::FpPluckerOperands<Words, Bits>;

  FpPluckerSetup(const ref::Ray& ray, const Format& /*binary32*/) : ray_(ray) {}

  static void boxes(std::span<const ref::Aabb> boxes, const Format& /*binary32*/, std::span<Box> out) {
    std::transform(boxes.begin(), boxes.end(), out.begin(), [](const ref::Aabb& box) { return Box(box); });
  }
  void fill(float length, Operands& in) const {
    const ref::FloatEndpoint end = ref::float_endpoint(ray_, length);
    put(patterns(ray_.origin), in.rx, in.ry, in.rz);
    put(patterns(end.at), in.rex, in.rey, in.rez);
    put(patterns(ray_.direction), in.ri, in.rj, in.rk);
    in.rinf = end.infinite ? 1 : 0;
  }

 private:
  ref::Ray ray_;
};

std::unique_ptr<ref::Tracer> fp_plucker_tracer(const TracedUnit& unit, const ref::Mesh& mesh,
                                               const ref::Bvh& bvh) {
  return ref::store_tracer(ref::PlainNodes(bvh), ref::TestMaker<ref::Plucker<float>>(),
                           ref::Leaves(mesh, bvh), {.ends = unit.ends});
}

ref::TracerOptions fp_plucker_named(const Format& /*binary32*/) {
  return {.algorithm = ref::Algorithm::plu_dsa, .arithmetic = ref::Arithmetic::binary32};
}

}  // namespace

Software fp_plucker_software() {
  Software software = fp_design_software();
  software.feed = set_up_feed<FpPluckerSetup>;
  software.box_test = set_up_test<FpPluckerSetup>;
  software.tracer = fp_plucker_tracer;
  software.named_tracer = fp_plucker_named;
  software.divisions = [](const Format& /*binary32*/) { return area::Divisions{}; };
  return software;
}

}  // namespace hitpipe::sim
