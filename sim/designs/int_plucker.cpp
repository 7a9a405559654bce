// The operands of hls::IntPluckerOperands (section 6.3.1).
#include "sw_ref/trace/int_plucker.hpp"

#include "hls/box/int_plucker_operands.hpp"
#include "rays/world/int_box.hpp"
#include "sim/designs/int_design.hpp"
#include "sim/designs/set_up_feed.hpp"
#include "sw_ref/hierarchy/int_nodes.hpp"
#include "sw_ref/quantise/int_plucker_ray.hpp"
#include "sw_ref/trace/store_tracer.hpp"

namespace hitpipe::sim {

namespace {

class IntPluckerSetup {
 public:
  using Box = ref::IntBox;
  using Bits = hls::IntBits;
  using Operands = hls::IntPluckerOperands<Words, Bits>;

  IntPluckerSetup(const ref::Ray& ray, const Format& format) : set_up_(ray, format.as<hls::IntBits>()) {}

  static void boxes(std::span<const ref::Aabb> boxes, const Format& format, std::span<Box> out) {
    ref::quantise_boxes(boxes, format.as<hls::IntBits>().coord, out);
  }
  void fill(float length, Operands& in) const {
    const ref::IntPluckerRay& ray = set_up_.ray();
    const ref::IntEndpoint end = set_up_.endpoint(length);
    put(ray.origin, in.irx, in.iry, in.irz);
    put(end.at, in.irex, in.irey, in.irez);
    put(ray.direction, in.iri, in.irj, in.irk);
    in.rinf = end.infinite ? 1 : 0;
  }

 private:
  ref::IntPluckerRaySetup set_up_;
};

std::unique_ptr<ref::Tracer> int_plucker_tracer(const TracedUnit& unit, const ref::Mesh& mesh,
                                                const ref::Bvh& bvh) {
  const auto bits = unit.format.as<hls::IntBits>();
  const ref::IntPluckerTestMaker make_test(bits, unit.coarse);
  return ref::store_tracer(ref::IntNodes(bvh, bits.coord, unit.coarse), make_test, ref::Leaves(mesh, bvh),
                           {.ends = unit.ends});
}

ref::TracerOptions int_plucker_named(const Format& format) {
  return {.algorithm = ref::Algorithm::plu_dsa,
          .arithmetic = ref::Arithmetic::integer,
          .bits = format.as<hls::IntBits>()};
}

/// The largest component of the direction is the limit itself.
area::Divisions int_plucker_divisions(const Format& format) {
  return {.count = 2, .quotient_bits = format.as<hls::IntBits>().coord};
}

}  // namespace

Software int_plucker_software() {
  Software software = int_design_software();
  software.feed = set_up_feed<IntPluckerSetup>;
  software.box_test = set_up_test<IntPluckerSetup>;
  software.tracer = int_plucker_tracer;
  software.named_tracer = int_plucker_named;
  software.divisions = int_plucker_divisions;
  return software;
}

}  // namespace hitpipe::sim
