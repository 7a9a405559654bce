// The fifth design's software: its set-up is that of int_slabs without the ray's end.
#include "tests/fifth_design/endless_slabs.hpp"

#include "sim/designs/int_design.hpp"
#include "sim/feeds/set_up_feed.hpp"
#include "sw_ref/hierarchy/int_nodes.hpp"
#include "sw_ref/quantise/int_box.hpp"
#include "sw_ref/quantise/int_slabs_ray.hpp"
#include "sw_ref/trace/int_slabs.hpp"
#include "sw_ref/trace/store_tracer.hpp"
#include "tests/fifth_design/designs.hpp"

namespace hitpipe::sim {

namespace {

class EndlessSetup {
 public:
  using Box = ref::IntBox;
  using Bits = hls::IntBits;
  using Operands = hls::EndlessSlabsOperands<Words, Bits>;

  EndlessSetup(const ref::Ray& ray, const rtl::Format& format) : set_up_(ray, format.as<hls::IntBits>()) {}

  static void boxes(std::span<const ref::Aabb> boxes, const rtl::Format& format, std::span<Box> out) {
    ref::quantise_boxes(boxes, format.as<hls::IntBits>().coord, out);
  }
  void fill(float /*length*/, Operands& in) const {
    const ref::IntSlabsRay& ray = set_up_.ray();
    put(ray.origin, in.irx, in.iry, in.irz);
    put(ray.irdvc_floor, in.iri_floor, in.irj_floor, in.irk_floor);
    put(ray.irdvc_ceil, in.iri_ceil, in.irj_ceil, in.irk_ceil);
  }

 private:
  ref::IntSlabsRaySetup set_up_;
};

std::unique_ptr<ref::Tracer> endless_tracer(const TracedUnit& unit, const ref::Mesh& mesh,
                                            const ref::Bvh& bvh) {
  const auto bits = unit.format.as<hls::IntBits>();
  return ref::store_tracer(ref::IntNodes(bvh, bits.coord), ref::IntSlabsTestMaker(bits),
                           ref::Leaves(mesh, bvh), {.ends = false});
}

}  // namespace

Software endless_slabs_software() {
  Software software = int_design_software();
  software.feed = set_up_feed<EndlessSetup>;
  software.box_test = set_up_test<EndlessSetup>;
  software.tracer = endless_tracer;
  return software;
}

}  // namespace hitpipe::sim
