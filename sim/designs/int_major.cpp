// The operands of hls::IntMajorOperands (docs/never_misses.md).
#include "rays/trace/int_major.hpp"

#include "sim/designs/major_design.hpp"
#include "sim/designs/set_up_feed.hpp"
#include "sw_ref/hierarchy/int_nodes.hpp"
#include "sw_ref/trace/store_tracer.hpp"

namespace hitpipe::sim {

namespace {

using hls::MajorBits;

class IntMajorSetup {
 public:
  using Box = ref::IntBox;
  using Bits = MajorBits;
  using Operands = hls::IntMajorOperands<Words, Bits>;

  IntMajorSetup(const ref::Ray& ray, const Format& format) : set_up_(ray, format.as<MajorBits>()) {}

  static bool meet(const ref::Ray& ray, std::span<const ref::Aabb> boxes, const Format& format,
                   std::span<bool> out) {
    return integer_meet(ray, boxes, format, out);
  }

  static void boxes(std::span<const ref::Aabb> boxes, const Format& format, std::span<Box> out) {
    major_boxes(boxes, format, out);
  }
  void fill(float length, Operands& in) const {
    put_major_ray(set_up_.ray(), in);
    in.len = set_up_.length(length);
  }

 private:
  MajorSetup set_up_;
};

std::unique_ptr<ref::Tracer> int_major_tracer(const TracedUnit& unit, const ref::Mesh& mesh,
                                              const ref::Bvh& bvh) {
  const MajorBits bits = float_world(unit.format);
  return ref::store_tracer(ref::IntNodes(bvh, bits.coord, {}, bits.finer), ref::IntMajorTestMaker(bits),
                           ref::Leaves(mesh, bvh), {.ends = unit.ends});
}

std::unique_ptr<SceneFeed> int_major_feed(const Format& format, const ref::Bvh& bvh) {
  return set_up_feed<IntMajorSetup>(float_world(format), bvh);
}

}  // namespace

Software int_major_software() {
  Software software = major_design_software();
  software.feed = int_major_feed;
  software.box_test = set_up_test<IntMajorSetup>;
  software.tracer = int_major_tracer;
  return software;
}

}  // namespace hitpipe::sim
