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

class EndlessSetUp {
 public:
  using Box = ref::IntBox;
  using End = int;

  EndlessSetUp(const ref::Ray& ray, const rtl::Format& format) : set_up_(ray, format.as<hls::IntBits>()) {}

  static void boxes(std::span<const ref::Aabb> boxes, const rtl::Format& format, std::span<Box> out) {
    ref::quantise_boxes(boxes, format.as<hls::IntBits>().coord, out);
  }
  [[nodiscard]] static End end(float /*length*/) { return 0; }

  void write(End /*none*/, bool /*rinf*/, const Box& box, std::int64_t* out) const {
    const ref::IntSlabsRay& ray = set_up_.ray();
    out = put(ray.origin, out);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      *out++ = ray.irdvc_floor[axis];
      *out++ = ray.irdvc_ceil[axis];
    }
    put_box(box, out);
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
  software.feed = set_up_feed<EndlessSetUp>;
  software.box_test = set_up_test<EndlessSetUp>;
  software.tracer = endless_tracer;
  return software;
}

}  // namespace hitpipe::sim
