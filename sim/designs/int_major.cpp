// The operands of hls::IntMajorOperands, in that order (docs/major.md).
#include <glm/vec3.hpp>

#include "rtl_gen/catalogue/major_formats.hpp"
#include "sim/feeds/set_up_feed.hpp"
#include "sim/software.hpp"
#include "sw_ref/encode/int_nodes.hpp"
#include "sw_ref/quantise/int_box.hpp"
#include "sw_ref/quantise/int_major_ray.hpp"

namespace hitpipe::sim {

namespace {

using hls::MajorBits;

class IntMajorSetUp {
 public:
  using Box = ref::IntBox;
  using End = std::int64_t;

  IntMajorSetUp(const ref::Ray& ray, const rtl::Format& format) : set_up_(ray, format.as<MajorBits>()) {}

  static void boxes(std::span<const ref::Aabb> boxes, const rtl::Format& format, std::span<Box> out) {
    const auto bits = format.as<MajorBits>();
    ref::quantise_boxes(boxes, bits.coord, out, bits.finer);
  }
  [[nodiscard]] End end(float length) const { return set_up_.length(length); }

  void write(End length, bool /*endless*/, const Box& box, std::int64_t* out) const {
    const ref::IntMajorRay& ray = set_up_.ray();
    for (const int axis : {1, 2}) *out++ = ray.axes[0] == axis ? 1 : 0;
    for (const bool backward : ray.backward) *out++ = backward ? 1 : 0;
    out = put(ray.origin, out);
    for (const ref::MajorQuotient& each : ray.quotient) {
      *out++ = each.mantissa_low;
      *out++ = each.mantissa_high;
    }
    for (const ref::MajorQuotient& each : ray.quotient) *out++ = each.exponent;
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
  ref::Bvh one;
  one.nodes.push_back({{glm::vec3(0), glm::vec3(0)}, 1, 0});
  const auto bits = format.as<MajorBits>();
  return ref::IntNodes(one, bits.coord, {}, bits.finer).bytes_per_node;
}

/// n = 12, 14, .. 24, with an origin that is 0 to 2 bits finer and mantissas of 10, 12 and 14 bits.
std::vector<rtl::Format> int_major_sweep_formats() {
  std::vector<rtl::Format> formats;
  for (int n = 12; n <= 24; n += 2)
    for (int finer = 0; finer <= 2; ++finer)
      for (int mantissa = 10; mantissa <= 14; mantissa += 2) formats.push_back(MajorBits{n, finer, mantissa});
  return formats;
}

}  // namespace

Software int_major_software() {
  return {.feed = set_up_feed<IntMajorSetUp>,
          .box_test = set_up_test<IntMajorSetUp>,
          .traversal = int_major_traversal,
          .bytes_per_node = int_major_bytes_per_node,
          .sweep_formats = int_major_sweep_formats(),
          .stiffness_formats = {MajorBits{20, 1, 12}, MajorBits{16, 1, 12}},
          .fit_from = MajorBits{20, 1, 12}};
}

}  // namespace hitpipe::sim
