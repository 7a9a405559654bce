// The operands of hls::FpSlabsOperands, in that order (section 2.3.1).
#include <algorithm>
#include <cmath>

#include "sim/designs/fp_design.hpp"
#include "sim/feeds/float_patterns.hpp"
#include "sim/feeds/set_up_feed.hpp"
#include "sw_ref/quantise/float_ray.hpp"
#include "sw_ref/trace/slabs.hpp"
#include "sw_ref/trace/store_tracer.hpp"

namespace hitpipe::sim {

namespace {

class FpSlabsSetUp {
 public:
  using Box = PatternBox;
  using End = std::uint32_t;

  FpSlabsSetUp(const ref::Ray& ray, const rtl::Format& /*binary32*/)
      : origin_(patterns(ray.origin)), irdvc_(patterns(ref::float_irdvc(ray.direction))) {}

  static void boxes(std::span<const ref::Aabb> boxes, const rtl::Format& /*binary32*/, std::span<Box> out) {
    std::transform(boxes.begin(), boxes.end(), out.begin(), [](const ref::Aabb& box) { return Box(box); });
  }
  [[nodiscard]] End end(float length) const { return pattern(std::abs(length)); }  // -0 is a length too

  void write(End rlen, bool rinf, const Box& box, std::int64_t* out) const {
    out = put(origin_, out);
    *out++ = rlen;
    out = put(irdvc_, out);
    *out++ = rinf ? 1 : 0;
    put_box(box, out);
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

ref::TracerOptions fp_slabs_named(const rtl::Format& /*binary32*/) {
  return {.algorithm = ref::Algorithm::slabs_dsa, .arithmetic = ref::Arithmetic::binary32};
}

}  // namespace

Software fp_slabs_software() {
  Software software = fp_design_software();
  software.feed = set_up_feed<FpSlabsSetUp>;
  software.box_test = set_up_test<FpSlabsSetUp>;
  software.tracer = fp_slabs_tracer;
  software.named_tracer = fp_slabs_named;
  software.beside = robust_float_slabs_test;
  return software;
}

}  // namespace hitpipe::sim
