// The operands of hls::IntSlabsOperands (section 6.2.1).
#include "sw_ref/trace/int_slabs.hpp"

#include <cmath>

#include "hls/box/int_slabs_operands.hpp"
#include "rays/world/int_box.hpp"
#include "sim/designs/int_design.hpp"
#include "sim/designs/set_up_feed.hpp"
#include "sw_ref/hierarchy/int_nodes.hpp"
#include "sw_ref/quantise/int_slabs_ray.hpp"
#include "sw_ref/trace/store_tracer.hpp"

namespace hitpipe::sim {

namespace {

class IntSlabsSetup {
 public:
  using Box = ref::IntBox;
  using Bits = hls::IntBits;
  using Operands = hls::IntSlabsOperands<Words, Bits>;

  IntSlabsSetup(const ref::Ray& ray, const Format& format) : set_up_(ray, format.as<hls::IntBits>()) {}

  static void boxes(std::span<const ref::Aabb> boxes, const Format& format, std::span<Box> out) {
    ref::quantise_boxes(boxes, format.as<hls::IntBits>().coord, out);
  }
  void fill(float length, Operands& in) const {
    const ref::IntSlabsRay& ray = set_up_.ray();
    put(ray.origin, in.irx, in.iry, in.irz);
    in.irlen = set_up_.length(length);
    put(ray.irdvc_floor, in.iri_floor, in.irj_floor, in.irk_floor);
    put(ray.irdvc_ceil, in.iri_ceil, in.irj_ceil, in.irk_ceil);
    in.rinf = std::isinf(length) ? 1 : 0;
  }

 private:
  ref::IntSlabsRaySetup set_up_;
};

std::unique_ptr<ref::Tracer> int_slabs_tracer(const TracedUnit& unit, const ref::Mesh& mesh,
                                              const ref::Bvh& bvh) {
  const auto bits = unit.format.as<hls::IntBits>();
  const ref::IntSlabsTestMaker make_test(bits, unit.coarse);
  return ref::store_tracer(ref::IntNodes(bvh, bits.coord, unit.coarse), make_test, ref::Leaves(mesh, bvh),
                           {.ends = unit.ends});
}

ref::TracerOptions int_slabs_named(const Format& format) {
  return {.algorithm = ref::Algorithm::slabs_dsa,
          .arithmetic = ref::Arithmetic::integer,
          .bits = format.as<hls::IntBits>()};
}

area::Divisions int_slabs_divisions(const Format& format) {
  return {.count = 3, .quotient_bits = format.as<hls::IntBits>().coord - 1};
}

}  // namespace

Software int_slabs_software() {
  Software software = int_design_software();
  software.feed = set_up_feed<IntSlabsSetup>;
  software.box_test = set_up_test<IntSlabsSetup>;
  software.tracer = int_slabs_tracer;
  software.named_tracer = int_slabs_named;
  software.divisions = int_slabs_divisions;
  return software;
}

}  // namespace hitpipe::sim
