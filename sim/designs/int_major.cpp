// The operands of hls::IntMajorOperands, in that order (docs/major.md).
#include "sw_ref/trace/int_major.hpp"

#include "sim/designs/major_design.hpp"
#include "sim/feeds/set_up_feed.hpp"
#include "sw_ref/hierarchy/int_nodes.hpp"
#include "sw_ref/trace/store_tracer.hpp"

namespace hitpipe::sim {

namespace {

using hls::MajorBits;

class IntMajorSetUp {
 public:
  using Box = ref::IntBox;
  using End = std::int64_t;

  IntMajorSetUp(const ref::Ray& ray, const rtl::Format& format) : set_up_(ray, format.as<MajorBits>()) {}

  static void boxes(std::span<const ref::Aabb> boxes, const rtl::Format& format, std::span<Box> out) {
    major_boxes(boxes, format, out);
  }
  [[nodiscard]] End end(float length) const { return set_up_.length(length); }

  void write(End length, bool /*endless*/, const Box& box, std::int64_t* out) const {
    out = put_major_ray(set_up_.ray(), out);
    *out++ = length;
    put_box(box, out);
  }

 private:
  ref::IntMajorRaySetup set_up_;
};

std::unique_ptr<ref::Tracer> int_major_tracer(const TracedUnit& unit, const ref::Mesh& mesh,
                                              const ref::Bvh& bvh) {
  const auto bits = unit.format.as<MajorBits>();
  return ref::store_tracer(ref::IntNodes(bvh, bits.coord, {}, bits.finer), ref::IntMajorTestMaker(bits),
                           ref::Leaves(mesh, bvh), {.ends = unit.ends});
}

}  // namespace

Software int_major_software() {
  Software software = major_design_software();
  software.feed = set_up_feed<IntMajorSetUp>;
  software.box_test = set_up_test<IntMajorSetUp>;
  software.tracer = int_major_tracer;
  return software;
}

}  // namespace hitpipe::sim
