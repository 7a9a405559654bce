// The operands of hls::IntMajorOperands, in that order (docs/major.md).
#include "sim/designs/major_design.hpp"
#include "sim/feeds/set_up_feed.hpp"
#include "sw_ref/hierarchy/int_nodes.hpp"

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

ref::TracerOptions int_major_traversal(const rtl::Format& format) {
  ref::TracerOptions options;
  options.algorithm = ref::Algorithm::slabs_dsa;
  options.arithmetic = ref::Arithmetic::major;
  options.major_bits = format.as<MajorBits>();
  return options;
}

std::size_t int_major_bytes_per_node(const rtl::Format& format, const ref::CoarseAxes& /*none*/) {
  return ref::IntNodes::node_bytes(format.as<MajorBits>().coord);
}

}  // namespace

Software int_major_software() {
  Software software = major_design_software();
  software.feed = set_up_feed<IntMajorSetUp>;
  software.box_test = set_up_test<IntMajorSetUp>;
  software.traversal = int_major_traversal;
  software.bytes_per_node = int_major_bytes_per_node;
  return software;
}

}  // namespace hitpipe::sim
