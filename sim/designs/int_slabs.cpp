// The operands of hls::IntSlabsOperands, in that order (section 6.2.1).
#include "sw_ref/trace/int_slabs.hpp"

#include "sim/designs/int_design.hpp"
#include "sim/feeds/set_up_feed.hpp"
#include "sw_ref/hierarchy/int_nodes.hpp"
#include "sw_ref/quantise/int_box.hpp"
#include "sw_ref/quantise/int_slabs_ray.hpp"
#include "sw_ref/trace/store_tracer.hpp"

namespace hitpipe::sim {

namespace {

class IntSlabsSetUp {
 public:
  using Box = ref::IntBox;
  using End = std::int64_t;

  IntSlabsSetUp(const ref::Ray& ray, const rtl::Format& format) : set_up_(ray, format.as<hls::IntBits>()) {}

  static void boxes(std::span<const ref::Aabb> boxes, const rtl::Format& format, std::span<Box> out) {
    ref::quantise_boxes(boxes, format.as<hls::IntBits>().coord, out);
  }
  [[nodiscard]] End end(float length) const { return set_up_.length(length); }

  void write(End irlen, bool rinf, const Box& box, std::int64_t* out) const {
    const ref::IntSlabsRay& ray = set_up_.ray();
    out = put(ray.origin, out);
    *out++ = irlen;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      *out++ = ray.irdvc_floor[axis];
      *out++ = ray.irdvc_ceil[axis];
    }
    *out++ = rinf ? 1 : 0;
    put_box(box, out);
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

ref::TracerOptions int_slabs_named(const rtl::Format& format) {
  return {.algorithm = ref::Algorithm::slabs_dsa,
          .arithmetic = ref::Arithmetic::integer,
          .bits = format.as<hls::IntBits>()};
}

}  // namespace

Software int_slabs_software() {
  Software software = int_design_software();
  software.feed = set_up_feed<IntSlabsSetUp>;
  software.box_test = set_up_test<IntSlabsSetUp>;
  software.tracer = int_slabs_tracer;
  software.named_tracer = int_slabs_named;
  return software;
}

}  // namespace hitpipe::sim
